// g.(x_j - x_i): times a density, less what a background bears of it, the pressure that the weight of a fluid
// at rest makes between a pair [m^2/s^2].
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

/// The pressure at j less that at i of a fluid with grains in it, where grad p = rho_l (g + d) at rest and in steady
/// flow: rho_l is the density of the fluid itself, d what drag accelerates it by, and grains carry their share of
/// grad p (models/drag.hpp).
template <class P>
[[nodiscard]] typename P::V rise_between_grains(const P& p) {
  using V = typename P::V;
  V sum = V::zero();
  for (int k = 0; k < P::dim; ++k)
    sum += (p.template i<Value::rest_gradient>(k) + p.template j<Value::rest_gradient>(k)) * p.e[k];
  return V(typename P::Scalar(0.5)) * sum;
}

/// The same of a wall i, of which nothing is known.
template <class P>
[[nodiscard]] typename P::V rise_from_wall(const P& p) {
  using V = typename P::V;
  V sum = V::zero();
  for (int k = 0; k < P::dim; ++k) sum += p.template j<Value::rest_gradient>(k) * p.e[k];
  return sum;
}

}  // namespace sph
