// Errors carry what is wrong and where; main turns them into one line and an exit code.
#pragma once

#include <stdexcept>
#include <string>

#include "decomp/types.hpp"

namespace sph {

using InputError =
    decomp::InputError;  ///< exit code 2: "file:line:column: key: what is wrong; what would be right"
using GuardError =
    decomp::GuardError;  ///< exit code 3: names particle, field, position, step and the key to change

/// A file could not be written during the run: exit code 4, the previous checkpoint is intact.
struct OutputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

enum ExitCode : int {
  exit_done = 0,
  exit_differ = 1,
  exit_input = 2,
  exit_guard = 3,
  exit_output = 4,
  exit_resume = 75
};

}  // namespace sph
