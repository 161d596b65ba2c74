// Gradient of the particle concentration with the pairing safeguard of Sun et al. (2017, delta-plus-SPH):
// S_i = sum_j V_j [1 + 0.2 (W/W(dx))^4] grad_i W. Beside it what models/shifting.hpp makes a length of: the
// concentration C = sum_j V_j W without the particle's own part, and over movers sum_j V_j W (v_ij . e_ij)^2,
// e_ij the direction of the pair: 0 for any rigid motion, so that no frame, and no rotation, is in it.
#pragma once

#include "sph/pairs/pair_values.hpp"

namespace sph {

struct Concentration {
  static constexpr std::string_view name = "Concentration";
  static constexpr ValueSet reads{Value::volume, Value::velocity, Value::mover};
  static constexpr Field writes = Field::spread;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    using V = typename P::V;
    const V value = Kernel::template value<P::dim>(p.r);
    const V w = value * V(c.inverse_w_spacing);
    const V w2 = w * w;
    const V s = p.template j<Value::volume>() * p.f * (V(1) + V(typename P::Scalar(0.2)) * (w2 * w2));
    V parting = V::zero();
    for (int a = 0; a < P::dim; ++a) {
      sums.template add<Field::spread>(a, -(s * p.e[a]));
      parting += (p.template j<Value::velocity>(a) - p.template i<Value::velocity>(a)) * p.e[a];
    }
    // Lists are padded with the particle itself.
    const V all = p.template j<Value::volume>() * value;
    const V share = all - where_equal(p.r2, V::zero(), all);
    sums.template add<Field::spread>(P::dim, share);
    const V square = parting * parting / max(p.r2, V(static_cast<typename P::Scalar>(1e-30)));
    sums.template add<Field::spread>(P::dim + 1, p.template j<Value::mover>() * share * square);
  }
};

}  // namespace sph
