// Contact of total-Lagrangian bodies: particles of different bodies that are closer than the spacing d push
// each other apart with the energy k (d - r)^2 / 2, k = kappa min(M_i, M_j) d^(D-2): a layer of particles in
// contact is kappa times as stiff as the material between two layers. Central and derived from an energy:
// momentum, angular momentum and energy are conserved.
#pragma once

#include "sph/pair_rows.hpp"

namespace sph {

struct BodyContact {
  static constexpr Term term = Term::body_contact;
  static constexpr ValueSet reads{Value::body, Value::modulus};
  static constexpr Field writes = Field::force;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    using V = typename P::V;
    const V modulus = min(p.template i<Value::modulus>(), p.template j<Value::modulus>());
    const V overlap = max(V(c.contact_range) - p.r, V::zero());
    const V push =
        V(c.contact_force) * modulus * overlap / max(p.r, V(static_cast<typename P::Scalar>(1e-30)));
    const V s = push - where_equal(p.template i<Value::body>(), p.template j<Value::body>(), push);
    for (int a = 0; a < P::dim; ++a) sums.template add<Field::force>(a, -(s * p.e[a]));
  }
};

/// Half the energy of a contact for either particle.
struct BodyContactEnergy {
  static constexpr Term term = Term::body_contact_energy;
  static constexpr ValueSet reads{Value::body, Value::modulus};
  static constexpr Field writes = Field::contact_energy;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    using V = typename P::V;
    const V modulus = min(p.template i<Value::modulus>(), p.template j<Value::modulus>());
    const V overlap = max(V(c.contact_range) - p.r, V::zero());
    const V energy = V(c.contact_energy) * modulus * (overlap * overlap);
    sums.template add<Field::contact_energy>(
        0, energy - where_equal(p.template i<Value::body>(), p.template j<Value::body>(), energy));
  }
};

}  // namespace sph
