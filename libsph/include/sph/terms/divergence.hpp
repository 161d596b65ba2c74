// Continuity by differences, Galilean invariant: div v_i = sum_j V_j (v_j - v_i).grad_i W, d rho/dt = -rho
// div v. VelocityGradient gives the whole tensor where the constitutive law needs it.
#pragma once

#include "sph/pairs/pair_values.hpp"

namespace sph {

struct Divergence {
  static constexpr std::string_view name = "Divergence";
  static constexpr ValueSet reads{Value::volume, Value::velocity};
  static constexpr Field writes = Field::divergence;
  static constexpr bool half_step_back = true;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C&, S& sums) {
    using V = typename P::V;
    V t = V::zero();
    for (int k = 0; k < P::dim; ++k)
      t += (p.template i<Value::velocity>(k) - p.template j<Value::velocity>(k)) * p.e[k];
    sums.template add<Field::divergence>(0, p.template j<Value::volume>() * p.f * t);
  }
};

/// The adjoint of WeightedPressure, so that pressure does the work that compression takes: each partner
/// counts 2 rho_j / (rho_i + rho_j) times. Without it an interface of 1:1000 at rest gains energy.
struct WeightedDivergence {
  static constexpr std::string_view name = "WeightedDivergence";
  static constexpr ValueSet reads{Value::volume, Value::velocity, Value::density, Value::mover};
  static constexpr Field writes = Field::divergence;
  static constexpr bool half_step_back = true;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C&, S& sums) {
    using V = typename P::V;
    V t = V::zero();
    for (int k = 0; k < P::dim; ++k)
      t += (p.template i<Value::velocity>(k) - p.template j<Value::velocity>(k)) * p.e[k];
    const V mover = p.template j<Value::mover>(), rho_j = p.template j<Value::density>();
    const V weight = where_equal(mover, V(1), (rho_j + rho_j) / (p.template i<Value::density>() + rho_j)) +
                     where_equal(mover, V::zero(), V(1));
    sums.template add<Field::divergence>(0, weight * p.template j<Value::volume>() * p.f * t);
  }
};

struct VelocityGradient {
  static constexpr std::string_view name = "VelocityGradient";
  static constexpr ValueSet reads{Value::volume, Value::velocity};
  static constexpr Field writes = Field::velocity_gradient;
  static constexpr bool half_step_back = true;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C&, S& sums) {
    const auto s = p.template j<Value::volume>() * p.f;
    for (int a = 0; a < P::dim; ++a) {
      const auto dv = s * (p.template i<Value::velocity>(a) - p.template j<Value::velocity>(a));
      for (int b = 0; b < P::dim; ++b)
        sums.template add<Field::velocity_gradient>(a * P::dim + b, dv * p.e[b]);
    }
  }
};

/// Where solids meet fluids. A solid is not strained by what flows past it: partners that are fluid count
/// with the isotropic part of their gradient alone, so that div v is that of all and the stress finds no
/// shear.
struct SlippingGradient {
  static constexpr std::string_view name = "SlippingGradient";
  static constexpr ValueSet reads{Value::volume, Value::velocity, Value::shears};
  static constexpr Field writes = Field::velocity_gradient;
  static constexpr bool half_step_back = true;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C&, S& sums) {
    using V = typename P::V;
    const V s = p.template j<Value::volume>() * p.f;
    const V whole = s * p.template j<Value::shears>();
    V approach = V::zero();
    for (int a = 0; a < P::dim; ++a)
      approach += (p.template i<Value::velocity>(a) - p.template j<Value::velocity>(a)) * p.e[a];
    const V mean = (s - whole) * approach * V(typename P::Scalar(1) / P::dim);
    for (int a = 0; a < P::dim; ++a) {
      const V dv = whole * (p.template i<Value::velocity>(a) - p.template j<Value::velocity>(a));
      for (int b = 0; b < P::dim; ++b)
        sums.template add<Field::velocity_gradient>(a * P::dim + b,
                                                    a == b ? dv * p.e[b] + mean : dv * p.e[b]);
    }
  }
};

}  // namespace sph
