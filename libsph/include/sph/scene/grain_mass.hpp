// Mass of a grain: a sphere of its material. One expression, so that a lattice, a particle file and a tile
// give the same bits.
#pragma once

#include <numbers>

namespace sph {

/// rho 4/3 pi r^3 [kg]
[[nodiscard]] constexpr double grain_mass(double density, double radius) {
  return density * (4.0 / 3.0 * std::numbers::pi) * (radius * radius * radius);
}

}  // namespace sph
