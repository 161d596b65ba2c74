// Rolling resistance: a rotational spring with history, a dashpot, and the limit mu_r R* F_n (Iwashita & Oda
// 1998; Ai et al. 2011, model C), k_r = 2.25 k (mu_r R*)^2, k the normal stiffness F/delta of the elastic
// force (Jiang et al. 2005 for the shape). Where k_r falls (as the contact unloads; the normal law says by
// which factor) the spring falls in proportion, as friction's does: its energy T^2 / (2 k_r) then falls by that
// factor too, and unloading makes none. The dashpot is a fraction eta of the critical one, 2 eta sqrt(I k_r),
// I = 7/5 m* R*^2 the inertia of a sphere about its contact with a wall.
// A contact that rolls on keeps the torque at the limit, against the roll.
#pragma once

#include "sph/pairs/contact.hpp"

namespace sph {

struct NoRolling {
  static constexpr int history = 0;
};

struct RollingSpring {
  static constexpr int history = 3;
  /// `change`: k_r now / a step ago where it fell, else 1. `spring` [3] is the history, updated; writes the
  /// torque on j [N m]; on i acts its opposite.
  template <class V>
  static void torque(const Contact<V>& c, const ContactConstants<V>& k, const NormalForce<V>& normal,
                     V change, V (&spring)[3], V (&torque)[3]) {
    const V along = spring[0] * c.normal[0] + spring[1] * c.normal[1] + spring[2] * c.normal[2];
    const V arm = k.rolling_friction * c.radius;
    const V stiffness = normal.elastic / max(c.overlap, V(1e-300));
    const V step = V(2.25) * stiffness * (arm * arm) * c.dt;
    const V dashpot = V(3.5496478698597698) * k.rolling_damping *  // 2 sqrt(7/5 * 2.25)
                      (arm * c.radius) * sqrt(stiffness * c.mass);
    V size2 = V::zero();
    for (int a = 0; a < 3; ++a) {
      spring[a] = (spring[a] - along * c.normal[a]) * change - step * c.roll[a];
      torque[a] = spring[a] - dashpot * c.roll[a];
      size2 += torque[a] * torque[a];
    }
    const V limit = arm * max(V(0.0), normal.force);
    const V scale = min(V(1.0), limit / max(sqrt(size2), V(1e-300)));
    for (int a = 0; a < 3; ++a) {
      torque[a] = torque[a] * scale;
      spring[a] = spring[a] * scale;
    }
  }
};

}  // namespace sph
