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
#include "sph/step/simulation.hpp"

namespace equivalence {

struct Case {
  Row row;
  std::vector<std::int64_t> steps;  ///< when states are compared, ascending; the last one ends the run
};

/// A stretch of a row on one number of ranks.
struct Leg {
  int ranks;
  std::int64_t from, to;  ///< steps; from > 0 resumes a checkpoint
};
[[nodiscard]] std::vector<Leg> legs_of(const Case& c, std::uint64_t seed);

struct Outcome {
  std::string mismatch;  ///< empty if all fingerprints agree
  std::int64_t rebuilds = 0;
};

class Cases {
 public:
  /// `scratch` is a directory of their own.
  Cases(std::uint64_t seed, std::filesystem::path scratch) : seed_(seed), scratch_(std::move(scratch)) {}

  /// On one rank alone: the scene's fingerprints there, and a file with its particles shuffled. Kept.
  void prepare(const decomp::Comm& one, const Case& c);
  /// One leg; collective over `comm`, which has leg.ranks ranks. Rank 0 must have prepared the case.
  Outcome run(const decomp::Comm& comm, const Case& c, const Leg& leg);
  /// After a mismatch, on rank 0 alone: the first particle and field that differ.
  [[nodiscard]] std::string explain(const decomp::Comm& one, const Row& row) const;

 private:
  struct Reference {
    std::unique_ptr<sph::Simulation> simulation;  ///< goes on when a case wants more steps
    Liveliness start;
    std::map<std::int64_t, std::string> fingerprint;  ///< by step
  };
  [[nodiscard]] bool differs(const sph::Simulation& simulation, const Row& row) const;
  [[nodiscard]] static std::string key(const Row& row);
  [[nodiscard]] std::filesystem::path run_dir(const Row& row) const;
  [[nodiscard]] std::filesystem::path start_file(const Row& row) const;
  [[nodiscard]] std::unique_ptr<sph::Simulation> begin(const decomp::Comm& comm, const Row& row,
                                                       sph::Scene& scene, const Leg& leg) const;
  void set_cuts(const decomp::Comm& comm, const Row& row, const Leg& leg, sph::Scene& scene) const;

  std::uint64_t seed_;
  std::filesystem::path scratch_;
  std::map<std::string, Reference> references_;
  std::int64_t mismatch_step_ = -1;
};

}  // namespace equivalence
