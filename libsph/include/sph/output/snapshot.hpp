// Snapshots: one parallel HDF5 file per output time plus one XDMF index (particles.xdmf) that ParaView opens.
// Layout, readable with six lines of h5py:  /particles/<field> (rows x components, attribute "unit"), where
// the scene asks for it also /contacts/id, partner, point, force, overlap (one row per contact of grains),
// attributes of the root: step, time, dt, quantum, fingerprint, scene (TOML), git, compiler, flags.
// Positions are written twice: `position` in metres (f64) and `position_quanta` (i64, exact bits). `stress`
// in 3D is xx yy zz xy yz xz, as ParaView takes it and the data set's attribute "components" says. /vertex
// counts the rows: one of ParaView's readers draws only points that a list of vertices names. Where cells of melts are
// among the rows, /cells/<field> is theirs as [z][y][x] (one z in two dimensions) and /others/<field> what is left
// (cell_mesh.hpp).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "decomp/comm.hpp"
#include "sph/core/particles.hpp"
#include "sph/files/provenance.hpp"
#include "sph/output/cell_mesh.hpp"

namespace sph {

class Simulation;
class State;

/// What a file says about the state in it.
[[nodiscard]] Provenance provenance(const State& state, std::string fingerprint);

/// A column that only snapshots have (time averages, space averages): owned rows, in row order.
struct ExtraColumn {
  std::string name, unit;
  int components = 1;
  std::vector<double> values;
  std::string component_names = {};  ///< empty: none
};

/// Contacts of grains, each on one rank only: `force` [N] acts on `id`, at `point` [m]; the partner has the
/// higher id, or is a wall (wall_key | index). Values of a contact: 1, 1, 3, 3, 1.
struct ContactColumns {
  std::vector<std::uint64_t> id, partner;
  std::vector<double> point, force, overlap;
};

/// Writes the state collectively to `path` (through a temporary name, renamed when complete) with rows
/// sorted by id if there are at most sort_limit, else in owner order. Throws OutputError on every rank if
/// any rank cannot write. Positions are written wrapped into the domain. Contacts, if any are given, are
/// sorted by (id, partner) under the same limit. With a mesh rows must be sorted, cells first. With a level of
/// compression, 1 to 9, rows are stored in chunks, shuffled and deflated (files/packed_rows.hpp).
void write_snapshot(const decomp::Comm& comm, const std::filesystem::path& path, const Particles& particles,
                    const GlobalState& global, const PositionScale& scale, const Wrap& wrap,
                    const Provenance& provenance, std::vector<ExtraColumn> extra, std::int64_t sort_limit,
                    std::optional<ContactColumns> contacts = {}, const std::optional<CellMesh>& mesh = {},
                    int compression = 0);
/// The same, with all that the scene asks for in its snapshots. May refresh halo copies and move rows.
void write_snapshot(Simulation& simulation, const std::filesystem::path& path);

/// Rewrites the XDMF index for the snapshots of a run, atomically (rank 0 only): one entry per file name,
/// time and row count. `fields` and `mesh` as in the files.
struct SnapshotEntry {
  std::string file;
  std::int64_t step;
  double time;
  std::int64_t rows;
};
void write_xdmf(const std::filesystem::path& path, const std::vector<SnapshotEntry>& entries,
                const Particles& particles, const std::vector<ExtraColumn>& extra,
                const std::optional<CellMesh>& mesh = {});

}  // namespace sph
