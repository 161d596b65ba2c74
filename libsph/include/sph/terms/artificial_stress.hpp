// Artificial stress (Monaghan 2000; Gray, Monaghan & Swift 2001, their R taken along the line between two particles, so
// that it needs no principal axes): a pair that is pulled apart repels each other with a part eps of the pull, the more
// the nearer they are, F_ij = V_i V_j eps (W/W(dx))^4 max(n.(sigma_i + sigma_j).n, 0) grad W. Without it particles of an
// updated-Lagrangian solid clump in tension (Swegle, Hicks & Attaway 1995).
#pragma once

#include "sph/pairs/pair_values.hpp"

namespace sph {

struct ArtificialStress {
  static constexpr std::string_view name = "ArtificialStress", word = "artificial_stress";
  static constexpr double most = 1;
  static constexpr std::string_view sentence =
      "eps of the artificial stress that keeps updated-Lagrangian solids from clumping in tension (0.2 to "
      "0.5).";
  static constexpr Effect effect = Effect::acceleration;
  static constexpr ValueSet reads{Value::stress, Value::volume, Value::density, Value::shears};
  static constexpr Field writes = Field::added;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    using V = typename P::V;
    V along = V::zero();
    for (int a = 0; a < P::dim; ++a)
      for (int b = 0; b < P::dim; ++b) {
        const int ab = symmetric_index(a, b, P::dim);
        along += (p.template i<Value::stress>(ab) + p.template j<Value::stress>(ab)) * (p.e[a] * p.e[b]);
      }
    const V near = Kernel::template value<P::dim>(p.r) * V(c.inverse_w_spacing);
    const V fourth = (near * near) * (near * near);
    const V both = p.template i<Value::shears>() * p.template j<Value::shears>();
    const V tiny(typename P::Scalar(1e-12));
    const V pull = max(along, V::zero()) / max(p.r2, tiny);
    const V s =
        (both * fourth * pull) * (p.template j<Value::volume>() * p.f) / p.template i<Value::density>();
    for (int a = 0; a < P::dim; ++a) sums.template add<Field::added>(a, s * p.e[a]);
  }
};

}  // namespace sph
