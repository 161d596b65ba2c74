// Monaghan's artificial viscosity between approaching particles (1992, eq. 4.2, beta = 0), in volume form:
// F_ij = V_i V_j rho_ij alpha c_ij h (v_ij.x_ij) / (r^2 + 0.01 h^2) grad_i W. Acts like nu = alpha h c / 8.
#pragma once

#include "sph/pairs/pair_values.hpp"

namespace sph {

/// Of the force along -e, times r.
template <class P, class C>
[[nodiscard]] typename P::V artificial_push(const P& p, const C& c) {
  using V = typename P::V;
  V approach = V::zero();  // (v_j - v_i).(x_j - x_i) / h, negative while the two approach
  for (int k = 0; k < P::dim; ++k)
    approach += (p.template j<Value::velocity>(k) - p.template i<Value::velocity>(k)) * p.e[k];
  approach = min(approach, V::zero());
  const V rho = p.template i<Value::density>() + p.template j<Value::density>();
  const V sound = p.template i<Value::sound_speed>() + p.template j<Value::sound_speed>();
  const V strength = V(c.artificial_viscosity * typename P::Scalar(0.25)) * (rho * sound);
  return p.template i<Value::volume>() * p.template j<Value::volume>() * strength *
         (approach / (p.r2 + V(typename P::Scalar(0.01)))) * p.f;
}

struct ArtificialViscosity {
  static constexpr std::string_view name = "ArtificialViscosity";
  static constexpr ValueSet reads{Value::volume, Value::velocity, Value::density, Value::sound_speed};
  static constexpr Field writes = Field::force;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    const auto s = artificial_push(p, c);
    for (int a = 0; a < P::dim; ++a) sums.template add<Field::force>(a, -(s * p.e[a]));
  }
};

}  // namespace sph
