// Newtonian viscosity with the harmonic mean eta_ij = 2 eta_i eta_j / (eta_i + eta_j), continuous in stress
// across a jump of viscosity; antisymmetric, so momentum is conserved. In volume form, f = W'/r:
//   Laplacian (Morris et al. 1997): F_ij = 2 eta_ij V_i V_j (v_i - v_j) f, that is div(eta grad v)
//   symmetric: F_ij = 2 (D + 2) eta_ij V_i V_j (v_ij.x_ij) x_ij f / m, that is div(eta (grad v + grad v^T)) +
//   grad(eta div v); central, so angular momentum is conserved too
// Each is divided by its moment on the lattice, -1/D sum V f r^2 (1.001 at h = dx, in the continuum 1) and m
// = -1/D sum V f r^4. Monaghan's symmetric form (2005, eq. 4.14) has / r^2 instead of / m. That weight takes
// the fourth moments n n n n from the nearest neighbours, of which a square lattice has but four: sheared
// along its rows it is 17 % less viscous at h = dx (8 % at 1.2 dx, falling as (dx/h)^2), stretched along them
// 6 % more. With f r^4 the lattice is isotropic within 0.1 %. Where eta is uniform and div v = 0 both are the
// same; the first is more accurate (Taylor-Green, Re 100, 50 x 50: L2 0.69 %, the second 0.92 %). Only the
// second has the right traction where eta jumps and at a free surface: with the first a rising bubble gets 5
// % too flat at any resolution, and a gravity wave, whose dissipation is all due to that condition
// (Colagrossi et al. 2011), decays at half its rate.
#pragma once

#include "sph/terms/harmonic_mean.hpp"

namespace sph {

/// Twice the mean.
template <class P>
typename P::V mean_viscosity(const P& p) {
  return twice_harmonic_mean(p.template i<Value::viscosity>(), p.template j<Value::viscosity>(),
                             typename P::V(static_cast<typename P::Scalar>(1e-30)));
}

template <Value velocity, class P, class C, class S>
void add_laplacian(const P& p, const C& c, typename P::V twice_mean, S& sums) {
  using V = typename P::V;
  const V s = p.template i<Value::volume>() * p.template j<Value::volume>() * twice_mean *
              (V(c.viscous.laplacian) * p.f);
  for (int k = 0; k < P::dim; ++k)
    sums.template add<Field::force>(k, s * (p.template i<velocity>(k) - p.template j<velocity>(k)));
}

template <Value velocity, class P, class C, class S>
void add_symmetric(const P& p, const C& c, typename P::V twice_mean, S& sums) {
  using V = typename P::V;
  V stretch = V::zero();
  for (int k = 0; k < P::dim; ++k)
    stretch += (p.template i<velocity>(k) - p.template j<velocity>(k)) * p.e[k];
  const V s = p.template i<Value::volume>() * p.template j<Value::volume>() * twice_mean *
              (V(c.viscous.symmetric) * p.f * stretch);
  for (int k = 0; k < P::dim; ++k) sums.template add<Field::force>(k, s * p.e[k]);
}

struct Viscosity {
  static constexpr std::string_view name = "Viscosity";
  static constexpr ValueSet reads{Value::volume, Value::velocity, Value::viscosity};
  static constexpr Field writes = Field::force;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    add_laplacian<Value::velocity>(p, c, mean_viscosity(p), sums);
  }
};

struct SymmetricViscosity {
  static constexpr std::string_view name = "SymmetricViscosity";
  static constexpr ValueSet reads = Viscosity::reads;
  static constexpr Field writes = Field::force;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    add_symmetric<Value::velocity>(p, c, mean_viscosity(p), sums);
  }
};

/// The Laplacian where all groups share one viscosity: no division and no value in the row.
struct UniformViscosity {
  static constexpr std::string_view name = "UniformViscosity";
  static constexpr ValueSet reads{Value::volume, Value::velocity};
  static constexpr Field writes = Field::force;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    using V = typename P::V;
    const V s =
        p.template i<Value::volume>() * p.template j<Value::volume>() * (V(2 * c.viscous.uniform) * p.f);
    for (int k = 0; k < P::dim; ++k)
      sums.template add<Field::force>(
          k, s * (p.template i<Value::velocity>(k) - p.template j<Value::velocity>(k)));
  }
};

}  // namespace sph
