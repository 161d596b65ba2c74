// What scale_sim can be asked for.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "model.hpp"

namespace scale_sim {

struct PolicyTable {
  std::vector<int> ranks{16, 64, 256, 484};
  double noise = 0.02;  ///< of a measured time, relative
  int slow_rank = -1;   ///< has half the speed
  int calls = 300;      ///< of the policy
};
void compare_policies(const PolicyTable& options);

struct Scaling {
  std::filesystem::path run;  ///< folder with perf.json and checkpoint
  std::vector<int> ranks{1000, 3162, 10000, 31623, 100000};
  double particles_per_rank = 1e6;  ///< weak scaling
  double particles = 1e10;          ///< strong scaling
  Network network;
};
void predict_scaling(const Scaling& options);

struct FlowPrediction {
  std::vector<int> ranks{1000, 10000, 100000};
  int iterations = 8, cells = 32;  ///< across the grid that is measured
  double tiles = 2;                ///< columns of 8 x 8 cells a rank, at least
  bool check = false;              ///< one flow on this many ranks of MPI instead
  Network network;
};
/// A flow of melts. Collective.
void predict_flow(const FlowPrediction& options);

/// What the model says of runs that were done, beside what they measured. Particles are where the last
/// snapshot has them, cuts those of the end; particle and row costs are those of the first run.
void check_model(const std::vector<std::filesystem::path>& runs, const Network& network);

}  // namespace scale_sim
