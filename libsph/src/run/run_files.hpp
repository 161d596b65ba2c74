// The files of a run: scene.toml, series.csv, snapshot_<step>.h5, particles.xdmf, checkpoint/, crash/.
// Every failure to write is an OutputError on all ranks, whichever rank met it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sph/output/monitors.hpp"
#include "sph/output/series.hpp"
#include "sph/output/snapshot.hpp"
#include "sph/step/simulation.hpp"

namespace sph {

/// What a checkpoint remembers besides the state, so that the files of a resumed run end as if it had never
/// stopped.
struct RunMemory {
  std::vector<std::uint64_t> monitor_ids;
  std::uint64_t series_bytes = 0;
  std::optional<std::uint64_t> series_hash;  ///< older checkpoints lack it
  std::vector<SnapshotEntry> snapshots;
};
[[nodiscard]] std::string to_json(const RunMemory& memory);
[[nodiscard]] RunMemory memory_from_json(const std::string& text);  ///< throws InputError

/// Whether a finished run has all its files, up to perf.json. Collective.
[[nodiscard]] bool is_complete(const Simulation& simulation, const std::filesystem::path& dir);

class RunFiles {
 public:
  /// Of a run from its beginning: removes what an earlier start without a checkpoint has left, writes
  /// scene.toml. `old_scene`: the resolved scene of that start, or empty; `followed`: by monitors of particles, Monitors. Throws InputError where nothing can
  /// be written. Collective, as all members are.
  RunFiles(const Simulation& simulation, std::filesystem::path dir, const std::string& old_scene,
           const std::vector<std::optional<std::uint64_t>>& followed);
  /// Of one that goes on: cuts series.csv and the XDMF index back to the checkpoint, and removes its own
  /// snapshots from step `first_snapshot` on that the checkpoint does not list.
  RunFiles(const Simulation& simulation, std::filesystem::path dir, const std::string& old_scene,
           const RunMemory& memory, std::int64_t first_snapshot);

  /// A row that rank 0 cannot write is its `failure` until the ranks meet in check(): no reduction for a row.
  void add_series_row(Simulation& simulation);
  [[nodiscard]] bool failed() const { return !failure_.empty(); }  ///< not collective
  void check(const Simulation& simulation) const;                  ///< throws what failed
  /// `scheduled`: it belongs to the run's rhythm and is remembered; the last state need not.
  void add_snapshot(Simulation& simulation, bool scheduled);
  void write_checkpoint(const Simulation& simulation);
  /// Where the state was kept for inspection. `together`: all ranks are here; else this one alone.
  [[nodiscard]] std::filesystem::path keep_crashed_state(const Simulation& simulation, bool together) const;

  [[nodiscard]] const std::filesystem::path& dir() const { return dir_; }
  [[nodiscard]] const std::vector<SnapshotEntry>& snapshots() const { return snapshots_; }

 private:
  void write_scene(const Simulation& simulation) const;
  void look_at_series();

  std::filesystem::path dir_;
  Monitors monitors_;
  std::optional<Series> series_;  ///< on rank 0
  std::uint64_t series_bytes_ = 0, series_hash_ = 0;
  std::string failure_;
  std::vector<SnapshotEntry> snapshots_;
};

}  // namespace sph
