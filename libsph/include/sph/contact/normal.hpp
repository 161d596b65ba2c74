// Normal forces. A dashpot c gives the restitution e that restitution.hpp finds c for; `least_force` = 0
// cuts off its pull at the end of a contact. max() is called so that a NaN comes through.
// The dashpot sees the velocity half a step late: with c it acts as c (1 + c dt / 2 m*). What is taken off it
// for that is of the order c^2 dt/m*, in which the mass drops out: damping_change times the stiffness, with a
// factor from restitution.hpp that makes e right in the mean over the ways to fall between two steps.
//   LinearNormal  F = k_n d - c v,           c = 2 zeta sqrt(k_n m*)             (Cundall & Strack 1979)
//   LinearRate    F = k_n d - gamma_n m* v                                       (Silbert et al. 2001, eq. 1)
//   HertzNormal   F = 4/3 E* sqrt(R*) d^1.5 - c v,  c = 2 sqrt(5/6) beta sqrt(S m*), S = 2 E* sqrt(R* d),
//                 k_t = 8 G* sqrt(R* d)      (Hertz 1882; Mindlin 1949; Tsuji et al. 1992)
#pragma once

#include "sph/contact/contact.hpp"

namespace sph {

template <class V>
NormalForce<V> linear_force(const Contact<V>& c, const ContactConstants<V>& k, V dashpot) {
  NormalForce<V> f;
  f.elastic = k.stiffness * c.overlap;
  f.force = max(k.least_force, f.elastic - dashpot * c.separation);
  f.shear_stiffness = k.shear_stiffness;
  f.shear_change = V(1.0);
  f.dashpot = dashpot;
  return f;
}

struct LinearNormal {
  template <class V>
  static NormalForce<V> force(const Contact<V>& c, const ContactConstants<V>& k) {
    return linear_force(c, k, k.damping * sqrt(k.stiffness * c.mass) + k.damping_change * k.stiffness);
  }
};

struct LinearRate {
  template <class V>
  static NormalForce<V> force(const Contact<V>& c, const ContactConstants<V>& k) {
    return linear_force(c, k, k.damping * c.mass);
  }
};

struct HertzNormal {
  template <class V>
  static NormalForce<V> force(const Contact<V>& c, const ContactConstants<V>& k) {
    NormalForce<V> f;
    const V overlap = max(V(0.0), c.overlap);
    const V patch = sqrt(c.radius * overlap);  // radius of the contact area [m]
    const V tangent = V(2.0) * k.stiffness * patch;
    f.dashpot = k.damping * sqrt(tangent * c.mass) + k.damping_change * tangent;
    f.elastic = V(2.0 / 3.0) * tangent * overlap;
    f.force = max(k.least_force, f.elastic - f.dashpot * c.separation);
    f.shear_stiffness = V(8.0) * k.shear_stiffness * patch;
    // The overlap a step ago from the present velocity: no further history.
    const V before = overlap + max(V(0.0), c.separation * c.dt);
    f.shear_change = sqrt(overlap / max(before, V(1e-300)));
    return f;
  }
};

}  // namespace sph
