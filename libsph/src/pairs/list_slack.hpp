// Lists are searched in single precision, so they hold a little more than they must. Whoever asks where a
// partner may be, such as the boundary of a rank whose rows wait for the halo, has to count with that.
#pragma once

#include <algorithm>

#include "decomp/grid.hpp"

namespace sph {

/// By how much of the list radius a listed partner may lie beyond it. Positions relative to the corner of a
/// rank's box are rounded to float: for x radii each coordinate of a difference is off by at most 2^-23 x,
/// the distance by at most 2.1e-7 x, and its square root by a few units in the last place.
[[nodiscard]] inline double list_slack(const decomp::CellGrid& grid, const decomp::Box& own,
                                       std::int64_t radius) {
  double extent = 0;  // of the box and two cells on either side, in radii
  for (int a = 0; a < grid.dim(); ++a) {
    const auto cells = static_cast<double>(own.hi[a] - own.lo[a] + 5);  // the last is longer than the others
    extent = std::max(extent, cells * static_cast<double>(grid.edge()[a]) / static_cast<double>(radius));
  }
  return 1e-5 + 1e-6 * extent;
}

}  // namespace sph
