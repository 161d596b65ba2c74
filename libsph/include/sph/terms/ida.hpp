// Ida's literal one-sided sums (seed 000, eqs. (6) and (10)), kept as the baseline of every comparison:
//   dv_a/dx_b = -sum_m v_a^m w_b(x^m - x^n) V^m        (8) is its trace, with the opposite sign
//   dv_a/dt   = -(1/rho^n) sum_b sum_m sigma_ab^m w_b(x^m - x^n) V^m
// They do not vanish for constant fields and do not conserve momentum.
#pragma once

#include "sph/pairs/pair_values.hpp"
#include "sph/terms/stress.hpp"

namespace sph {

struct IdaGradient {
  static constexpr std::string_view name = "IdaGradient";
  static constexpr ValueSet reads{Value::volume, Value::velocity};
  static constexpr Field writes = Field::velocity_gradient;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C&, S& sums) {
    const auto s = p.template j<Value::volume>() * p.f;
    for (int a = 0; a < P::dim; ++a)
      for (int b = 0; b < P::dim; ++b)
        sums.template add<Field::velocity_gradient>(a * P::dim + b,
                                                    -(s * p.template j<Value::velocity>(a) * p.e[b]));
  }
};

/// As a force: m a = V rho a.
struct IdaStress {
  static constexpr std::string_view name = "IdaStress";
  static constexpr ValueSet reads{Value::volume, Value::stress};
  static constexpr Field writes = Field::force;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C&, S& sums) {
    using V = typename P::V;
    const V s = p.template i<Value::volume>() * p.template j<Value::volume>() * p.f;
    for (int a = 0; a < P::dim; ++a) {
      V t = V::zero();
      for (int b = 0; b < P::dim; ++b)
        t += p.template j<Value::stress>(symmetric_index(a, b, P::dim)) * p.e[b];
      sums.template add<Field::force>(a, -(s * t));
    }
  }
};

}  // namespace sph
