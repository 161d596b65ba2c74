// Newtonian viscosity, Morris et al. (1997) in volume form: F_ij = 2 eta_ij V_i V_j (v_i - v_j) W'/r with the
// harmonic mean eta_ij = 2 eta_i eta_j / (eta_i + eta_j), continuous in stress across a jump of viscosity.
// Antisymmetric, so momentum is conserved.
#pragma once

#include "sph/pair_rows.hpp"

namespace sph {

struct Viscosity {
  static constexpr Term term = Term::viscosity;
  static constexpr ValueSet reads{Value::volume, Value::velocity, Value::viscosity};
  static constexpr Field writes = Field::force;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C&, S& sums) {
    using V = typename P::V;
    const V a = p.template i<Value::viscosity>(), b = p.template j<Value::viscosity>();
    const V eta = V(4) * (a * b) / max(a + b, V(static_cast<typename P::Scalar>(1e-30)));
    const V s = p.template i<Value::volume>() * p.template j<Value::volume>() * eta * p.f;
    for (int k = 0; k < P::dim; ++k)
      sums.template add<Field::force>(
          k, s * (p.template i<Value::velocity>(k) - p.template j<Value::velocity>(k)));
  }
};

/// The same where all groups share one viscosity: no division and no value in the row.
struct UniformViscosity {
  static constexpr Term term = Term::uniform_viscosity;
  static constexpr ValueSet reads{Value::volume, Value::velocity};
  static constexpr Field writes = Field::force;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    using V = typename P::V;
    const V s = p.template i<Value::volume>() * p.template j<Value::volume>() * (V(2 * c.viscosity) * p.f);
    for (int k = 0; k < P::dim; ++k)
      sums.template add<Field::force>(
          k, s * (p.template i<Value::velocity>(k) - p.template j<Value::velocity>(k)));
  }
};

/// The force along the line of centres instead (Monaghan & Gingold 1983; Monaghan 2005):
/// F_ij = 2 (D+2) eta_ij V_i V_j (v_ij.x_ij) x_ij W' / r^3, so that angular momentum is conserved too. Inside
/// a fluid the two are the same but for 2 eta grad div v. At a free surface they are not: a sum that ends
/// there leaves no eta dv/dn in the first form and no traction n.eta (grad v + grad v^T) in this one, which
/// is the physical condition (Colagrossi et al. 2011). A gravity wave, whose dissipation is all due to it,
/// decays at half its rate with the first. In shear this one weighs distant partners more, as x^2 y^2 / r^2,
/// and with them the crude velocities of no-slip walls and disorder.
struct RadialViscosity {
  static constexpr Term term = Term::radial_viscosity;
  static constexpr ValueSet reads{Value::volume, Value::velocity, Value::viscosity};
  static constexpr Field writes = Field::force;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C&, S& sums) {
    using V = typename P::V;
    const V a = p.template i<Value::viscosity>(), b = p.template j<Value::viscosity>();
    const V tiny(static_cast<typename P::Scalar>(1e-30));
    const V eta = V(4 * (P::dim + 2)) * (a * b) / max(a + b, tiny);
    V along = V::zero();
    for (int k = 0; k < P::dim; ++k)
      along += (p.template i<Value::velocity>(k) - p.template j<Value::velocity>(k)) * p.e[k];
    const V s =
        p.template i<Value::volume>() * p.template j<Value::volume>() * eta * p.f * (along / max(p.r2, tiny));
    for (int k = 0; k < P::dim; ++k) sums.template add<Field::force>(k, s * p.e[k]);
  }
};

}  // namespace sph
