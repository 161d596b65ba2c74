// Makes a failure on one rank a failure on all, with one text. Files are written in phases that do not
// communicate; between two phases the ranks agree, so that none waits for one that has given up.
#pragma once

#include <exception>
#include <string>

#include "decomp/comm.hpp"
#include "sph/core/error.hpp"

namespace sph {

/// The text of the lowest rank whose `failure` is not empty; empty if there is none. Collective.
[[nodiscard]] std::string agree(const decomp::Comm& comm, const std::string& failure);

/// Runs `work` and returns the text of what it threw, empty if it threw nothing.
template <class Work>
[[nodiscard]] std::string attempt(Work&& work) {
  try {
    work();
  } catch (const std::exception& error) {
    const std::string text = error.what();
    return text.empty() ? "unknown error" : text;
  }
  return {};
}

/// Runs `work`, which must not communicate, on every rank; if it throws anywhere, throws
/// OutputError("<what>: <text>") everywhere. Collective.
template <class Work>
void all_or_none(const decomp::Comm& comm, const std::string& what, Work&& work) {
  const std::string failure = agree(comm, attempt(work));
  if (!failure.empty()) throw OutputError(what + ": " + failure);
}

}  // namespace sph
