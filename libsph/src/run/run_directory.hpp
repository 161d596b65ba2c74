// Whose is what in the directory of a run. Nothing that a run did not write is ever deleted or overwritten:
// - a new run wants a directory that does not exist or holds no file named like a run's own;
// - a run that goes on deletes, of what it finds, the leftovers of interrupted writing (<own name>.tmp) and
// the
//   snapshots of its own scene beyond its checkpoint, which it will write again bit for bit. If a file of
//   such a name is of another scene, it is refused; files of other names are not looked at.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "decomp/comm.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

[[nodiscard]] std::string snapshot_name(std::int64_t step);
/// The step of a file with exactly that name.
[[nodiscard]] std::optional<std::int64_t> step_of_snapshot(const std::filesystem::path& file);

/// Throws InputError if the directory holds a file named like a run's own. `locked`: it is this run's, and
/// what a killed one has left is gone. Collective.
void refuse_used_directory(const decomp::Comm& comm, const std::filesystem::path& dir, bool locked,
                           const std::string& option = "--out");

/// Deletes what interrupted writing of a run has left. One rank.
void remove_leftovers(const std::filesystem::path& dir);

/// Deletes snapshots of the run from step `first` on, but those `listed`. `scenes`: its resolved scenes,
/// which may differ in the run's end. InputError if such a file is not the run's. One rank.
void remove_snapshots(const std::filesystem::path& dir, std::int64_t first,
                      const std::vector<std::string>& listed, const std::vector<std::string>& scenes);

/// Makes the scene's file of recorded cuts ready for more. InputError, before anything is written, if it exists
/// and is neither empty nor, where the run goes on with its `own`, a record, or has the name of another file in the
/// run's directory. Collective.
void prepare_record(const decomp::Comm& comm, const Scene& scene, const std::filesystem::path& dir, bool own);

}  // namespace sph
