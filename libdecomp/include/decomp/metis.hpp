// METIS as comparison partitioner on the same cell graph. The only place that knows metis.h is its .cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "decomp/grid.hpp"

namespace decomp {

struct GraphPartition {
  std::vector<int> part;    ///< of each cell, x fastest
  double imbalance;         ///< max / mean of the summed cell costs
  std::int64_t halo_cells;  ///< cells that some other part needs, summed over parts
};

/// k-way partition of the grid's cells weighted by `cost` (>= 0, one per cell, x fastest), neighbours being
/// the cells that share a face, edge or corner. Throws InputError if ranks exceeds the number of cells.
[[nodiscard]] GraphPartition metis_partition(const CellGrid& grid, const std::vector<double>& cost,
                                             int ranks);

/// The same two measures for a partition made elsewhere, so that both are judged alike.
[[nodiscard]] GraphPartition measure_partition(const CellGrid& grid, const std::vector<double>& cost,
                                               std::vector<int> part, int ranks);

}  // namespace decomp
