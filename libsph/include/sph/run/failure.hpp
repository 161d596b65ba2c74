// From an exception on some or all ranks to one line on stderr and one exit code. If every rank has failed,
// as with bad input, all return; if only some have, the others wait in a call that will never be answered,
// and the program must be ended for them.
#pragma once

#include <exception>
#include <functional>
#include <optional>

#include "decomp/comm.hpp"

namespace sph {

class Failure {
 public:
  /// Collective.
  explicit Failure(const decomp::Comm& comm) : comm_(comm), quiet_(comm.get()) {}

  /// Runs `work` and returns its exit code or that of what it threw.
  [[nodiscard]] int guard(const std::function<int()>& work);

  /// True if all ranks ask within a few seconds, so that collective calls are possible. For ranks that have
  /// failed; the answer stays.
  [[nodiscard]] bool everywhere();

 private:
  [[nodiscard]] int report(const std::exception& error);

  const decomp::Comm& comm_;
  decomp::Comm quiet_;  ///< carries no message but those about failure
  std::optional<bool> everywhere_;
};

}  // namespace sph
