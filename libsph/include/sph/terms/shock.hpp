// Artificial viscosity for shocks (Monaghan 1992, eqs. 4.2 and 4.3), in volume form, between particles that
// approach each other: F_ij = V_i V_j rho_ij (alpha c_ij - beta mu) mu grad_i W, mu = h v_ij.x_ij / (r^2 +
// 0.01 h^2), rho_ij the harmonic mean, which leaves the lighter of two at most twice its own acceleration, h
// and grad_i W the means of both. Of v_ij that is left out which the gradients of the velocity at i and j
// explain, their harmonic mean, where both have the same sign (Frontiere et al. 2017, van Leer's limiter): in
// smooth flow, compressed or sheared, hardly anything is left, in a shock it is all there.
// The quadratic part, that of von Neumann and Richtmyer, keeps particles of strong shocks apart. In an ideal
// gas each of the two gets half the heat that the pair's viscous forces make, and what is conducted between
// them: V_i V_j alpha_u rho_ij v (u_j - u_i) |grad W|, v = sqrt(|p_i - p_j| / rho_ij) (Price 2008, less the
// hydrostatic part of p_i - p_j), which smooths the energy that a sharp start leaves behind at a contact and
// is none where pressures are in balance. Pair by pair no energy is made or lost, but beside walls, whose
// velocities are not their own.
#pragma once

#include "sph/pairs/pair_values.hpp"
#include "sph/terms/head.hpp"
#include "sph/terms/viscosity.hpp"

namespace sph {

template <class P>
typename P::V mean_density(const P& p) {
  using V = typename P::V;
  const V a = p.template i<Value::density>(), b = p.template j<Value::density>();
  return V(static_cast<typename P::Scalar>(2)) * a * b / (a + b);
}

/// (v_j - v_i).(x_j - x_i) / h less its smooth part, at most 0.
template <class P>
typename P::V approach_of(const P& p) {
  using V = typename P::V;
  V approach = V::zero(), at_i = V::zero(), at_j = V::zero();
  for (int a = 0; a < P::dim; ++a) {
    V row_i = V::zero(), row_j = V::zero();
    for (int b = 0; b < P::dim; ++b) {
      row_i += p.template i<Value::velocity_gradient>(a * P::dim + b) * p.e[b];
      row_j += p.template j<Value::velocity_gradient>(a * P::dim + b) * p.e[b];
    }
    at_i += row_i * p.e[a];
    at_j += row_j * p.e[a];
    approach += (p.template j<Value::velocity>(a) - p.template i<Value::velocity>(a)) * p.e[a];
  }
  const V product = at_i * at_j;
  const V smooth =
      where_less(V::zero(), product, V(static_cast<typename P::Scalar>(2)) * product / (at_i + at_j));
  return where_less(approach, V::zero(), min(approach - smooth, V::zero()));
}

/// F_ij = -push e
template <class P, class C>
typename P::V shock_push(const P& p, const C& c) {
  using V = typename P::V;
  using T = typename P::Scalar;
  const V h = V(static_cast<T>(0.5)) * (p.template i<Value::width>() + p.template j<Value::width>());
  const V mu = h * approach_of(p) / (p.r2 + V(static_cast<T>(0.01)) * (h * h));
  const V rho = mean_density(p);
  const V sound = p.template i<Value::sound_speed>() + p.template j<Value::sound_speed>();
  const V signal =
      V(c.artificial_viscosity * static_cast<T>(0.5)) * sound - V(c.shock.quadratic_viscosity) * mu;
  return p.template i<Value::volume>() * p.template j<Value::volume>() * (rho * signal) * mu * p.f;
}

struct ShockViscosity {
  static constexpr std::string_view name = "ShockViscosity";
  static constexpr ValueSet reads{Value::volume,      Value::velocity, Value::density,
                                  Value::sound_speed, Value::width,    Value::velocity_gradient};
  static constexpr Field writes = Field::force;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    const auto push = shock_push(p, c);
    for (int a = 0; a < P::dim; ++a) sums.template add<Field::force>(a, -(push * p.e[a]));
  }
};

struct ShockHeating {
  static constexpr std::string_view name = "ShockHeating";
  static constexpr ValueSet reads =
      ShockViscosity::reads | ValueSet{Value::pressure, Value::viscosity, Value::specific_energy};
  static constexpr Field writes = Field::heating;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    using V = typename P::V;
    const V half(static_cast<typename P::Scalar>(0.5));
    V work = V::zero();
    const V push = shock_push(p, c);
    const V volumes = p.template i<Value::volume>() * p.template j<Value::volume>() * p.f;
    const V viscous = volumes * (V(c.viscous.laplacian) * mean_viscosity(p));  // as in Viscosity
    for (int k = 0; k < P::dim; ++k) {
      const V dv = p.template i<Value::velocity>(k) - p.template j<Value::velocity>(k);
      const V force = viscous * dv - push * p.e[k];
      work += force * dv;
      sums.template add<Field::heating>(1 + k, force);
    }
    const V u_i = p.template i<Value::specific_energy>(), u_j = p.template j<Value::specific_energy>();
    const V rho = mean_density(p);
    const V excess = p.template i<Value::pressure>() - p.template j<Value::pressure>() + rho * head(p, c);
    const V flux = V(c.shock.conduction) * sqrt(rho * max(excess, -excess)) * (u_i - u_j) * p.r;
    const V inert = where_equal(min(u_i, u_j), V::zero(), flux);  // with what has no energy of its own
    sums.template add<Field::heating>(0, volumes * (flux - inert) - half * work);
  }
};

}  // namespace sph
