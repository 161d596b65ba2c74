// A whole run, as both a new one and one that goes on: banner, steps, what is written when, checkpoints, stop
// conditions, final report. Everything here may change the files of a run, never a bit of its particles.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sph/run/failure.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

struct RunOptions {
  std::string scene;                   ///< TOML file of a new run ...
  std::filesystem::path resume;        ///< ... or the directory of one that goes on
  std::filesystem::path branch;        ///< ... whose state begins a new run here
  std::filesystem::path out;           ///< of a new run; empty: out/<stem of the scene file>
  std::vector<std::string> overrides;  ///< "a.b=v"
  End end;                             ///< instead of what the scene says
  std::optional<double> max_seconds;   ///< of wall time: then checkpoint and stop
  bool plan = false;                   ///< check: print the stages of a step
};

/// Collective. Returns exit_done, or exit_resume if it was stopped with a checkpoint. Throws InputError,
/// GuardError (the state is then kept in <out>/crash) and OutputError.
[[nodiscard]] int run_case(const RunOptions& options, const decomp::Comm& comm, Failure& failure);

/// `peperite check`: validates, places the particles, prints what a run would cost. Collective.
[[nodiscard]] int check_case(const RunOptions& options, const decomp::Comm& comm);

/// The scene that the options describe.
[[nodiscard]] Scene scene_of(const RunOptions& options);

/// To be called before MPI_Init, whose own handlers would end the program. SIGUSR1 and SIGTERM: checkpoint
/// and stop; SIGUSR2: checkpoint and go on; a second SIGTERM ends the program at once.
void install_signal_handlers();
/// For programs that only read: signals end them.
void restore_signal_handlers();

}  // namespace sph
