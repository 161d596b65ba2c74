// WaltonBraun  F = k_1 d while the contact loads, k_2 (d - d_0) on the way back and up again until the first
//              line is met (Walton & Braun 1986): latched springs, no dashpot. Of the work k_1 d^2/2 of an
//              impact k_1/k_2 comes back, so that k_2 = k_1 / e^2 gives the restitution e at any speed.
// With d_0 the largest of (1 - k_1/k_2) d so far, both lines are F = max(0, k_2 (d - d_0)). d_0 is the history
// of the contact, a deformation: the same from either side. It is 0 again when the two have parted.
// Rolling resistance follows F/d = k_2 (1 - d_0/d), which falls as a contact unloads; the rolling spring falls in
// proportion (pairs/rolling.hpp), as Thornton's rule has it for k_t of Hertz contacts.
// normal_stiffness is that of a material's k_1; the least restitution of a pair makes k_2.
#pragma once

#include "sph/laws/contact/linear.hpp"

namespace sph {

struct WaltonBraun : Springs {
  static constexpr std::string_view word = "walton_braun", name = "Walton-Braun";
  static constexpr std::array history{Parity::even};

  template <class V>
  static NormalForce<V> force(const Contact<V>& c, const ContactConstants<V>& k, V* latched) {
    latched[0] = max(latched[0], k.damping * c.overlap);  // damping: 1 - k_1/k_2
    NormalForce<V> f;
    f.elastic = f.force = max(V(0.0), k.stiffness * (c.overlap - latched[0]));
    f.shear_stiffness = k.shear_stiffness;
    f.shear_change = V(1.0);
    f.dashpot = V::zero();
    return f;
  }
  /// Of F/d. The overlap a step ago follows from the present velocity, as in hertz.hpp: d_0 as it was then is no
  /// other, unless it has grown since, which F/d does not fall by.
  template <class V>
  static V rolling_change(const Contact<V>& c, const ContactConstants<V>& k, const NormalForce<V>& /*f*/,
                          const V* latched) {
    const auto share = [&](V overlap) {  // of k_2
      const V gap = overlap - max(latched[0], k.damping * overlap);
      return max(V(0.0), gap) / max(overlap, V(1e-300));
    };
    const V before = share(c.overlap + max(V(0.0), c.separation * c.dt));
    return min(V(1.0), share(c.overlap) / max(before, V(1e-300)));
  }
  /// What comes back: F^2 / (2 k_2).
  template <class V>
  static V energy(const Contact<V>& /*c*/, const ContactConstants<V>& k, const NormalForce<V>& f) {
    return V(0.5) * f.elastic * f.elastic / k.stiffness;
  }
  static PairConstants constants(const MaterialPair& p) {
    const auto [loading, shear] = springs(p);
    const double e2 = p.restitution * p.restitution;
    return {loading / e2, shear, 1 - e2};
  }
};

}  // namespace sph
