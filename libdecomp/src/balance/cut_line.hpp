// What the cut policies share: a line of cuts and the check that costs and cuts belong together.
#pragma once

#include <cstdint>
#include <numeric>
#include <span>
#include <stdexcept>
#include <vector>

#include "decomp/partition.hpp"

namespace decomp {

using CutLine = std::vector<std::int64_t>;  ///< [parts + 1], from 0 to the number of cells

inline void check_costs(const Cuts& cuts, std::span<const double> cost) {
  if (cost.size() != part_count(cuts))
    throw std::invalid_argument("one cost for each part is needed to balance the cuts");
}

}  // namespace decomp
