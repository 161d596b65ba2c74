// g.(x_j - x_i): times a density the pressure that the weight of a fluid at rest makes between a pair
// [m^2/s^2].
#pragma once

#include "sph/pairs/pair_values.hpp"

namespace sph {

template <class P, class C>
[[nodiscard]] typename P::V head(const P& p, const C& c) {
  using V = typename P::V;
  V sum = V::zero();
  for (int k = 0; k < P::dim; ++k) sum += V(c.gravity[k]) * p.e[k];
  return sum;
}

}  // namespace sph
