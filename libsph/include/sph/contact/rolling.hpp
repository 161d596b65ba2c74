// Rolling resistance: a rotational spring with history up to the limit mu_r R* F_n (Iwashita & Oda 1998;
// Ai et al. 2011, model C without its dashpot), k_r = 2.25 k (mu_r R*)^2, k the normal stiffness F/delta
// of the elastic force (Jiang et al. 2005 for the shape). Where k_r falls with the overlap (as k_t does, by
// the same factor) the spring falls in proportion, so that unloading makes no energy. A contact that rolls
// on keeps the spring at the limit: a constant torque against the roll.
#pragma once

#include "sph/contact/contact.hpp"

namespace sph {

struct NoRolling {
  static constexpr int history = 0;
};

struct RollingSpring {
  static constexpr int history = 3;
  /// `spring` [3] is the history and the torque on j [N m]; on i acts its opposite.
  template <class V>
  static void torque(const Contact<V>& c, const ContactConstants<V>& k, const NormalForce<V>& normal,
                     V (&spring)[3]) {
    const V along = spring[0] * c.normal[0] + spring[1] * c.normal[1] + spring[2] * c.normal[2];
    const V arm = k.rolling_friction * c.radius;
    const V step = V(2.25) * (normal.elastic / max(c.overlap, V(1e-300))) * (arm * arm) * c.dt;
    V size2 = V::zero();
    for (int a = 0; a < 3; ++a) {
      spring[a] = (spring[a] - along * c.normal[a]) * normal.shear_change - step * c.roll[a];
      size2 += spring[a] * spring[a];
    }
    const V limit = arm * max(V(0.0), normal.force);
    const V scale = min(V(1.0), limit / max(sqrt(size2), V(1e-300)));
    for (int a = 0; a < 3; ++a) spring[a] = spring[a] * scale;
  }
};

}  // namespace sph
