// Contact of total-Lagrangian bodies: particles of different bodies that are closer than the spacing d push
// each other apart with the energy k (d - r)^2 / 2, k = kappa min(M_i, M_j) d^D / h^2: a layer of particles
// in contact is about kappa times as stiff as the material between two layers, and k over the mass follows
// the square of the time step's own c/h. Central and derived from an energy: momentum, angular momentum and
// energy are conserved. Rows of particles interlock: there is friction of a sort.
#pragma once

#include "sph/pairs/pair_values.hpp"

namespace sph {

/// `overlap` / h.
template <class P, class C, class S>
void add_contact(const P& p, const C& c, typename P::V overlap, S& sums) {
  using V = typename P::V;
  const V modulus = min(p.template i<Value::modulus>(), p.template j<Value::modulus>());
  const V push = V(c.contact.force) * modulus * overlap;
  const V s = push / max(p.r, V(static_cast<typename P::Scalar>(1e-30)));
  for (int a = 0; a < P::dim; ++a) sums.template add<Field::force>(a, -(s * p.e[a]));
}

/// Half the energy of a contact for either particle.
template <class P, class C, class S>
void add_contact_energy(const P& p, const C& c, typename P::V overlap, S& sums) {
  using V = typename P::V;
  const V modulus = min(p.template i<Value::modulus>(), p.template j<Value::modulus>());
  sums.template add<Field::contact_energy>(0, V(c.contact.energy) * modulus * (overlap * overlap));
}

struct BodyContact {
  static constexpr std::string_view name = "BodyContact";
  static constexpr ValueSet reads{Value::body, Value::modulus};
  static constexpr Field writes = Field::force;
  static constexpr bool of_bonds = true;
  static constexpr Value nothing_without = Value::modulus;
  template <class P, class C>
  static auto overlap(const P& p, const C& c) {
    using V = typename P::V;
    const V o = max(V(c.contact.range) - p.r, V::zero());
    return o - where_equal(p.template i<Value::body>(), p.template j<Value::body>(), o);
  }
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    add_contact(p, c, overlap(p, c), sums);
  }
};

struct BodyContactEnergy {
  static constexpr std::string_view name = "BodyContactEnergy";
  static constexpr ValueSet reads = BodyContact::reads;
  static constexpr Field writes = Field::contact_energy;
  static constexpr bool of_bonds = true;
  static constexpr Value nothing_without = Value::modulus;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    add_contact_energy(p, c, BodyContact::overlap(p, c), sums);
  }
};

}  // namespace sph
