// Tangential force on j: a spring with history, carried with the contact plane, a dashpot, and Coulomb's
// limit mu F_n (Cundall & Strack 1979). The history is the spring's force t [N]: it grows by -k_t slip dt;
// where k_t falls with the overlap it falls in proportion, so that unloading makes no energy (Thornton et
// al. 2013); it is turned into the present contact plane by projection, which loses only the square of the
// angle of one step. Where a contact slides, spring and dashpot shrink by one factor: the force is at the
// limit and the spring only ever loses (a spring at the limit plus the dashpot's force would reverse, and
// hold more energy than the impact had, where the dashpot alone exceeds the limit).
// What it does not conserve, at any time step: a linear spring that is still loaded when its contact ends
// takes its energy with it (rough elastic grains, e = 1, lose about 0.2 % of theirs a collision; Hertz's k_t
// falls to 0 before), and the arm of its torque is the radius r, as in Silbert et al. 2001, not r - d/2 of
// the point of contact: angular momentum is off by a share d/2r of what the contact turns.
#pragma once

#include "sph/pairs/contact.hpp"

namespace sph {

/// Smooth spheres: no tangential force, no history, no spin.
struct NoFriction {
  static constexpr int history = 0;
};

struct Coulomb {
  static constexpr int history = 3;
  /// `spring` [3] is the history, updated; writes the force on j [N].
  template <class V>
  static void force(const Contact<V>& c, const ContactConstants<V>& k, const NormalForce<V>& normal,
                    V (&spring)[3], V (&force)[3]) {
    const V along = spring[0] * c.normal[0] + spring[1] * c.normal[1] + spring[2] * c.normal[2];
    const V dashpot = k.shear_damping * normal.dashpot;
    const V step = normal.shear_stiffness * c.dt;
    V size2 = V::zero();
    for (int a = 0; a < 3; ++a) {
      spring[a] = (spring[a] - along * c.normal[a]) * normal.shear_change - step * c.slip[a];
      force[a] = spring[a] - dashpot * c.slip[a];
      size2 += force[a] * force[a];
    }
    const V limit = k.friction * max(V(0.0), normal.force);
    const V scale = min(V(1.0), limit / max(sqrt(size2), V(1e-300)));
    for (int a = 0; a < 3; ++a) {
      force[a] = force[a] * scale;
      spring[a] = spring[a] * scale;
    }
  }
};

}  // namespace sph
