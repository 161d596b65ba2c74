// Gradient of the particle concentration with the pairing safeguard of Sun et al. (2017, delta-plus-SPH):
// S_i = sum_j V_j [1 + 0.2 (W/W(dx))^4] grad_i W. The update moves particles by -2 h U_max dt S_i.
#pragma once

#include "sph/pair_rows.hpp"

namespace sph {

struct Shifting {
  static constexpr Term term = Term::shifting;
  static constexpr ValueSet reads{Value::volume};
  static constexpr Field writes = Field::spread;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    using V = typename P::V;
    const V value = Kernel::template value<P::dim>(p.r);
    const V w = value * V(c.inverse_w_spacing);
    const V w2 = w * w;
    const V s = p.template j<Value::volume>() * p.f * (V(1) + V(typename P::Scalar(0.2)) * (w2 * w2));
    for (int a = 0; a < P::dim; ++a) sums.template add<Field::spread>(a, -(s * p.e[a]));
    // Lists are padded with the particle itself.
    const V share = p.template j<Value::volume>() * value;
    sums.template add<Field::spread>(P::dim, share - where_equal(p.r2, V::zero(), share));
  }
};

}  // namespace sph
