// What a step takes on many ranks: a code and a network, both by a few numbers, and the boxes of a partition.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "decomp/cell_costs.hpp"

namespace scale_sim {

/// Measured, from perf.json of a run on few ranks; seconds and bytes.
struct Code {
  double particle = 0;       ///< a step of a particle
  double halo_row = 0;       ///< packing and unpacking, a step
  double rebuild_row = 0;    ///< lists and sorting, of a rebuild, an owned row
  double rebuild_every = 1;  ///< steps
  double refresh_bytes = 0;  ///< a halo row, a step
  double refreshes = 1;      ///< messages to a neighbour, a step
  double memory = 0;         ///< a particle, all told
  double row = 0;            ///< a halo row in memory
  double checkpoint = 0;     ///< a particle, on disk
  double setup = 0;          ///< a particle
};
/// Throws std::runtime_error naming the file and what it lacks.
[[nodiscard]] Code read_code(const std::filesystem::path& perf_json);

/// Stated, not measured.
struct Network {
  double latency = 2e-6;   ///< of a message, and of each of the log2(ranks) rounds of a reduction [s]
  double bandwidth = 2e9;  ///< of one rank while all send [bytes/s]
  double disk = 100e9;     ///< of the file system, all ranks together [bytes/s]
};

/// Particles in columns of cells. A run of more particles is a larger domain, not a finer one.
struct Domain {
  const char* name;
  std::vector<double> (*field)(std::int64_t rows, std::int64_t columns);
  double aspect;    ///< columns / rows
  double per_cell;  ///< particles
  double depth;     ///< cells of a column that hold particles, mean; 0: as many as the domain is wide
};

/// What a step takes with given cuts. Times are of the rank that is last, in seconds.
struct Step {
  double imbalance = 1, halo = 0, largest_halo = 0;  ///< copies: a particle in the mean, rows of a rank
  double compute = 0, pack = 0, exposed = 0, reduce = 0, rebuild = 0;
  double cpu = 0;       ///< of all ranks together
  double messages = 0;  ///< time of the messages, behind computation or not
  double memory = 0;    ///< bytes of the largest rank
  [[nodiscard]] double total() const { return compute + pack + exposed + reduce + rebuild; }
};
/// `particles`: in cells; periodic: along rows, along columns; `third`: cells across the uncut axis where
/// that is periodic, else 0. A halo is one cell deep.
struct Layout {
  std::array<bool, 2> periodic{};
  double third = 0;
};
[[nodiscard]] Step predict(const decomp::CellCosts& particles, const decomp::Cuts& cuts, const Layout& layout,
                           const Code& code, const Network& network);

}  // namespace scale_sim
