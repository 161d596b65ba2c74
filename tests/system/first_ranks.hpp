// One MPI program on 8 ranks that runs many cases, each on the first k of them: communicators of those, a
// wait that takes no core from them, and a directory for all.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>

#include "decomp/comm.hpp"

namespace equivalence {

inline constexpr int most_ranks = 8;

/// A barrier at which waiting costs nothing: ranks that have no part in a row must not take the cores of
/// those that have.
void sleep_until_all_are_here(MPI_Comm world);

/// Communicators of the first k ranks, k = 1 to 8; null where this rank is not among them.
class SubComms {
 public:
  explicit SubComms(const decomp::Comm& world);
  [[nodiscard]] const decomp::Comm* first(int k) const { return comms_[static_cast<std::size_t>(k)].get(); }

 private:
  std::array<std::unique_ptr<decomp::Comm>, most_ranks + 1> comms_;
};

/// A directory of rank 0's making that goes with it.
class Scratch {
 public:
  Scratch(const decomp::Comm& world, const std::string& name);
  ~Scratch();
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  bool mine_;
  std::filesystem::path path_;
};

}  // namespace equivalence
