// What the program makes of an exception (libsph/src/run/failure.cpp), without ending: the exit code and the
// text that it would print, if all ranks have failed.
#pragma once

#include <functional>
#include <string>

#include "decomp/comm.hpp"

namespace fuzz {

inline constexpr int code_input = 2;

struct Report {
  int code = 0;
  std::string text;
};

/// Runs `work` on all ranks of `comm` and returns what it threw, code 0 if nothing. Where only some ranks
/// failed, the others wait in a call that will never be answered: the program is ended with a line about
/// `name` on stdout.
[[nodiscard]] Report agreed(const decomp::Comm& comm, const std::string& name,
                            const std::function<void()>& work);

}  // namespace fuzz
