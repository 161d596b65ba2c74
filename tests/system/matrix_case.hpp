// Runs one row of the matrix: from the start, perhaps through a checkpoint onto another number of ranks, to
// the end; and the 1-rank reference that it must agree with.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "decomp/comm.hpp"
#include "factors.hpp"
#include "matrix_scenes.hpp"
#include "sph/simulation.hpp"

namespace equivalence {

using Steps = std::vector<std::int64_t>;  ///< when states are compared, ascending; the last one ends a run

/// A stretch of a row on one number of ranks.
struct Leg {
  int ranks;
  std::int64_t from, to;  ///< steps; from > 0 resumes a checkpoint
};
[[nodiscard]] std::vector<Leg> legs_of(const Row& row, std::int64_t steps, std::uint64_t seed);

struct Outcome {
  std::string mismatch;  ///< empty if all fingerprints agree
  std::int64_t rebuilds = 0;
};

/// All of a row's ranks, and nobody else, work on one; every path below `scratch` is theirs.
class Cases {
 public:
  Cases(Steps steps, std::uint64_t seed, std::filesystem::path scratch)
      : steps_(std::move(steps)), seed_(seed), scratch_(std::move(scratch)) {}

  /// On one rank alone: fingerprints of the scene on one rank, and its shuffled start. Cached.
  void prepare(const decomp::Comm& one, const Row& row);
  /// One leg; collective over `comm`, which has leg.ranks ranks. Rank 0 must have prepared the row.
  Outcome run(const decomp::Comm& comm, const Row& row, const Leg& leg);
  /// After a mismatch, on rank 0 alone: the first particle and field that differ.
  [[nodiscard]] std::string explain(const decomp::Comm& one, const Row& row) const;

 private:
  using Fingerprints = std::map<std::int64_t, std::string>;
  [[nodiscard]] std::string key(const Row& row) const;
  [[nodiscard]] std::filesystem::path run_dir(const Row& row) const;
  [[nodiscard]] std::filesystem::path start_dir(const Row& row) const;
  [[nodiscard]] std::unique_ptr<sph::Simulation> begin(const decomp::Comm& comm, const Row& row,
                                                       const sph::Scene& scene, const Leg& leg) const;
  void set_cuts(const decomp::Comm& comm, const Row& row, const Leg& leg, sph::Scene& scene) const;

  Steps steps_;
  std::uint64_t seed_;
  std::filesystem::path scratch_;
  std::map<std::string, Fingerprints> references_;
  std::int64_t mismatch_step_ = -1;
};

}  // namespace equivalence
