// The points of a lattice of grains in a fluid, and the ids of their grains, which follow on those of the fluid's
// lattice, one fill after the other.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "sph/scene/scene.hpp"

namespace sph {

/// How many points a fill has along an axis.
[[nodiscard]] inline std::int64_t points_of(const GrainFill& fill, std::size_t axis) {
  return std::max<std::int64_t>(
      static_cast<std::int64_t>(std::ceil((fill.upper[axis] - fill.lower[axis]) / fill.spacing - 0.5)), 0);
}
[[nodiscard]] inline std::int64_t count(const GrainFill& fill) {
  return points_of(fill, 0) * points_of(fill, 1) * points_of(fill, 2);
}
[[nodiscard]] inline Double3 point(const GrainFill& fill, const std::array<std::int64_t, 3>& k) {
  Double3 x{};
  for (std::size_t a = 0; a < 3; ++a) x[a] = fill.lower[a] + (static_cast<double>(k[a]) + 0.5) * fill.spacing;
  return x;
}

}  // namespace sph
