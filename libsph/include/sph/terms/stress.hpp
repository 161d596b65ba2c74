// Divergence of a symmetric stress in volume form: F_ij = V_i V_j (sigma_i + sigma_j) grad_i W. The pressure
// force is its isotropic part.
#pragma once

#include "sph/pairs/pair_values.hpp"

namespace sph {

template <Value Stress>
struct TensorDivergence {
  static constexpr ValueSet reads{Value::volume, Stress};
  static constexpr Field writes = Field::force;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C&, S& sums) {
    using V = typename P::V;
    const V s = p.template i<Value::volume>() * p.template j<Value::volume>() * p.f;
    for (int a = 0; a < P::dim; ++a) {
      V t = V::zero();
      for (int b = 0; b < P::dim; ++b) {
        const int ab = symmetric_index(a, b, P::dim);
        t += (p.template i<Stress>(ab) + p.template j<Stress>(ab)) * p.e[b];
      }
      sums.template add<Field::force>(a, -(s * t));
    }
  }
};

struct StressDivergence : TensorDivergence<Value::stress> {
  static constexpr std::string_view name = "StressDivergence";
};

/// Adjoint to SlippingGradient: between a solid and a fluid the mean of the normal stresses acts, which in
/// the fluid is the pressure, and no shear. With all of the solid's stress a layer two kernel lengths thick
/// of an inviscid fluid would stick to it. The stress of fluids and walls is isotropic: theirs are the same
/// sums.
struct SlippingStress {
  static constexpr std::string_view name = "SlippingStress";
  static constexpr ValueSet reads{Value::volume, Value::stress, Value::shears};
  static constexpr Field writes = Field::force;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C&, S& sums) {
    using V = typename P::V;
    const V s = p.template i<Value::volume>() * p.template j<Value::volume>() * p.f;
    const V whole = s * (p.template i<Value::shears>() * p.template j<Value::shears>());
    V trace = V::zero();
    for (int a = 0; a < P::dim; ++a) {
      const int aa = symmetric_index(a, a, P::dim);
      trace += p.template i<Value::stress>(aa) + p.template j<Value::stress>(aa);
    }
    const V mean = (s - whole) * trace * V(typename P::Scalar(1) / P::dim);
    for (int a = 0; a < P::dim; ++a) {
      V t = V::zero();
      for (int b = 0; b < P::dim; ++b) {
        const int ab = symmetric_index(a, b, P::dim);
        t += (p.template i<Value::stress>(ab) + p.template j<Value::stress>(ab)) * p.e[b];
      }
      sums.template add<Field::force>(a, -(whole * t + mean * p.e[a]));
    }
  }
};

}  // namespace sph
