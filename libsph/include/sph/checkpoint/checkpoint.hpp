// Checkpoints: the whole state in owner order, in a few parallel HDF5 files, plus a manifest that is renamed
// last. Every block of rows carries its hash; reading falls back to the previous checkpoint if one does not
// agree. Two are kept. Layout:  DIR/checkpoint/<step>/part_<k>.h5, DIR/checkpoint/<step>/manifest.json.
#pragma once

#include <filesystem>
#include <string>

#include "decomp/comm.hpp"
#include "decomp/table.hpp"
#include "sph/core/particles.hpp"
#include "sph/files/provenance.hpp"

namespace sph {

/// What a run needs besides particles to go on as if never stopped.
struct RunRecord {
  GlobalState global;
  PositionScale scale;
  std::string scene_toml;
  std::string extra_json;  ///< any text: output schedule, monitors, lengths of series.csv and the XDMF index
};

/// What a checkpoint has of these fields: the state, and what snapshots show of its last step, which no state says.
[[nodiscard]] FieldSet kept_of(FieldSet fields);

/// Collective. On return the checkpoint is complete and on disk (fsync by every writer, manifest renamed
/// last), and all but it and the newest complete one of an earlier step are gone. Throws OutputError on every
/// rank if any rank fails; what was there before is then untouched. `files` = 0 means one per 512 ranks.
/// Positions are written wrapped.
void write_checkpoint(const decomp::Comm& comm, const std::filesystem::path& run_dir,
                      const Particles& particles, const decomp::Payload* history, const RunRecord& record,
                      const Wrap& wrap, const Provenance& provenance, int files);

/// Finds the newest checkpoint under run_dir and reads its record, without particles. Throws InputError when
/// there is none that is complete, naming what is wrong with each. `warning` says if the newest was skipped.
struct CheckpointHandle {
  std::filesystem::path dir;
  RunRecord record;
  std::string warning;
  bool other_laws =
      false;  ///< what goes on follows others than what was: nothing that it derives is as it was
};
/// Reads every block's hash too (collective; each rank checks its share), so that the choice is final.
[[nodiscard]] CheckpointHandle find_checkpoint(const decomp::Comm& comm,
                                               const std::filesystem::path& run_dir);

/// Appends this rank's share of the rows (any rows: the caller redistributes them) to empty `particles`. Returns which
/// fields besides the state it had: those that it lacks stay 0.
FieldSet read_checkpoint(const decomp::Comm& comm, const CheckpointHandle& handle, Particles& particles,
                         decomp::Payload* history);

}  // namespace sph
