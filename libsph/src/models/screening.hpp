// What of the disturbance that a grain makes in a fluid other grains around it leave.
#pragma once

#include <algorithm>

namespace sph {

/// Share of a grain's own disturbance that grains around it leave: the structure factor of hard spheres for
/// long waves (Carnahan & Starling 1969).
[[nodiscard]] inline double unscreened(double solid) {
  const double e = 1 - solid, e2 = e * e, a = 1 + 2 * solid;
  return e2 * e2 / (a * a + solid * solid * solid * (solid - 4));
}

/// Of a grain at random among others the averages see its own share whole and, where it keeps them out, less of the
/// others: solid = c + unscreened(c) own, c that of them all far and wide; 0 if it is alone.
[[nodiscard]] inline double solid_around(double solid, double own) {
  constexpr int rounds = 8;
  constexpr double most = 0.74;
  double c = 0;
  for (int round = 0; round < rounds; ++round) c = std::clamp(solid - unscreened(c) * own, 0.0, most);
  return c;
}

}  // namespace sph
