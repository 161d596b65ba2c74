// The simulation that the options ask for: a new one, or one from the newest usable checkpoint of a run.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "run/run_files.hpp"
#include "run/run_lock.hpp"
#include "sph/run/run.hpp"

namespace sph {

struct RunStart {
  std::filesystem::path dir;
  std::unique_ptr<RunLock> lock;
  std::string old_scene;  ///< resolved, of the start before; empty: there is none
  std::unique_ptr<Simulation> simulation;
  std::optional<RunMemory> memory;  ///< of the checkpoint; none: begins a series of its own
  /// Of a branch: what its monitors of particles follow, where the run before had them too.
  std::vector<std::optional<std::uint64_t>> followed;
};

/// Collective; InputError on all ranks.
[[nodiscard]] RunStart start_new(const RunOptions& options, const decomp::Comm& comm);
/// A new run, in a directory of its own, that begins with the newest checkpoint of another and a scene that differs from its in
/// constants.
[[nodiscard]] RunStart start_branch(const RunOptions& options, const decomp::Comm& comm);
/// A run that was ended before its first checkpoint begins anew.
[[nodiscard]] RunStart start_again(const RunOptions& options, const decomp::Comm& comm);

[[nodiscard]] bool is_finished(const Scene& scene, const GlobalState& global);

/// Does `work`; an InputError in it that does not say so is about the scene's file.
template <class Work>
auto naming_file(const Scene& scene, Work&& work) {
  try {
    return work();
  } catch (const InputError& error) {
    const std::string text = error.what();
    if (text.starts_with(scene.file)) throw;
    throw InputError(scene.file + ": " + text);
  }
}

}  // namespace sph
