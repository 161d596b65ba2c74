// Artificial viscosity for shocks (Monaghan 1992, eqs. 4.2 and 4.3), in volume form, between particles that
// approach each other: F_ij = V_i V_j rho_ij (alpha c_ij - beta mu) mu grad_i W, mu = h v_ij.x_ij / (r^2 +
// 0.01 h^2), rho_ij the harmonic mean, which leaves the lighter of two at most twice its own acceleration.
// The quadratic part, that of von Neumann and Richtmyer, keeps particles of strong shocks apart. In an ideal
// gas each of the two gets half the heat that the pair's viscous forces make, and what is conducted between
// them: V_i V_j alpha_u rho_ij v (u_j - u_i) |grad W|, v = sqrt(|p_i - p_j| / rho_ij) (Price 2008, less the
// hydrostatic part of p_i - p_j), which smooths the energy that a sharp start leaves behind at a contact and
// is none where pressures are in balance. Pair by pair no energy is made or lost, but beside walls, whose
// velocities are not their own.
#pragma once

#include "sph/pair_rows.hpp"
#include "sph/terms/head.hpp"
#include "sph/terms/viscosity.hpp"

namespace sph {

template <class P>
typename P::V mean_density(const P& p) {
  using V = typename P::V;
  const V a = p.template i<Value::density>(), b = p.template j<Value::density>();
  return V(static_cast<typename P::Scalar>(2)) * a * b / (a + b);
}

/// F_ij = -push e; `approach` is (v_j - v_i).(x_j - x_i) / h, at most 0.
template <class P, class C>
typename P::V shock_push(const P& p, const C& c, typename P::V& approach) {
  using V = typename P::V;
  using T = typename P::Scalar;
  approach = V::zero();
  for (int k = 0; k < P::dim; ++k)
    approach += (p.template j<Value::velocity>(k) - p.template i<Value::velocity>(k)) * p.e[k];
  approach = min(approach, V::zero());
  const V mu = approach / (p.r2 + V(static_cast<T>(0.01)));
  const V rho = mean_density(p);
  const V sound = p.template i<Value::sound_speed>() + p.template j<Value::sound_speed>();
  const V signal = V(c.artificial_viscosity * static_cast<T>(0.5)) * sound - V(c.quadratic_viscosity) * mu;
  return p.template i<Value::volume>() * p.template j<Value::volume>() * (rho * signal) * mu * p.f;
}

struct ShockViscosity {
  static constexpr Term term = Term::shock_viscosity;
  static constexpr ValueSet reads{Value::volume, Value::velocity, Value::density, Value::sound_speed};
  static constexpr Field writes = Field::force;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    typename P::V approach;
    const auto push = shock_push(p, c, approach);
    for (int a = 0; a < P::dim; ++a) sums.template add<Field::force>(a, -(push * p.e[a]));
  }
};

struct ShockHeating {
  static constexpr Term term = Term::shock_heating;
  static constexpr ValueSet reads =
      ShockViscosity::reads | ValueSet{Value::pressure, Value::viscosity, Value::specific_energy};
  static constexpr Field writes = Field::heating;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    using V = typename P::V;
    const V half(static_cast<typename P::Scalar>(0.5));
    V approach, work = V::zero();
    const V push = shock_push(p, c, approach);
    const V volumes = p.template i<Value::volume>() * p.template j<Value::volume>() * p.f;
    const V viscous = volumes * (V(c.laplacian) * mean_viscosity(p));  // as in Viscosity
    for (int k = 0; k < P::dim; ++k) {
      const V dv = p.template i<Value::velocity>(k) - p.template j<Value::velocity>(k);
      const V force = viscous * dv - push * p.e[k];
      work += force * dv;
      sums.template add<Field::heating>(1 + k, force);
    }
    const V u_i = p.template i<Value::specific_energy>(), u_j = p.template j<Value::specific_energy>();
    const V rho = mean_density(p);
    const V excess = p.template i<Value::pressure>() - p.template j<Value::pressure>() + rho * head(p, c);
    const V flux = V(c.conduction) * sqrt(rho * max(excess, -excess)) * (u_i - u_j) * p.r;
    const V inert = where_equal(min(u_i, u_j), V::zero(), flux);  // with what has no energy of its own
    sums.template add<Field::heating>(0, volumes * (flux - inert) - half * work);
  }
};

}  // namespace sph
