// Bonds beside cracks. A particle that has failed is fluid and has no bonds; what else spans the crack are bonds between
// its two faces, round the particle that failed, and with them it opens 28 % too little. Each particle therefore has the
// vector
//   n_i = sum over what failed beside it of w X_ik,   X_ik from i to the failed k in the reference state,
// state, and a bond within 37 degrees of n at both of its ends is cut: n_i.X > 0.8 |n_i| |X|, n_j.(-X) > 0.8 |n_j| |X|.
// A failed particle's vector is the normal m of its crack's plane, and what fails next beside it asks for the sums of w m m
// and of w m d, d its distance from that plane (models/failure.cpp).
// Faces of a crack come no nearer to each other than they were: what failed between them keeps its place, or a crack that
// closes would press it out, and with it more melt than came in.
// Across a crack that is narrower than the kernel the faces press on each other with the fluid's pressure, or a row of it
// would transmit 0.82 to 0.93 of it. The work that does is that of the fluid, whose continuity has the same pairs.
#pragma once

#include "sph/terms/body_contact.hpp"
#include "sph/terms/bonds.hpp"
#include "sph/terms/wetted.hpp"

namespace sph {

/// 1 where j is on the side of i's crack and i on that of j's, within an angle of this cosine; else 0.
template <class P>
[[nodiscard]] typename P::V faces(const P& p, double cosine) {
  using V = typename P::V;
  V at_i = V::zero(), at_j = V::zero(), square = V::zero();
  for (int a = 0; a < P::dim; ++a) {
    const V x = p.bond.reference[a];
    at_i += p.template i<Value::crack>(a) * x;
    at_j -= p.template j<Value::crack>(a) * x;
    square += x * x;
  }
  const V least = V(static_cast<typename P::Scalar>(cosine)) * sqrt(square), one(1);
  return where_less(least, at_i, where_less(least, at_j, one));
}

/// 1 for bonds that no crack cuts.
template <class P>
[[nodiscard]] typename P::V uncut(const P& p) {
  return typename P::V(1) - faces(p, 0.8);
}

struct CrackedDeformation {
  static constexpr std::string_view name = "CrackedDeformation";
  static constexpr ValueSet reads = Deformation::reads | ValueSet{Value::crack};
  static constexpr Field writes = Field::deformation;
  static constexpr bool of_bonds = true;
  static constexpr Value nothing_without = Value::modulus;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C&, S& sums) {
    add_deformation(p, uncut(p), sums);
  }
};

struct CrackedBondForce {
  static constexpr std::string_view name = "CrackedBondForce";
  static constexpr ValueSet reads = BondForce::reads | ValueSet{Value::crack};
  static constexpr Field writes = Field::force;
  static constexpr bool of_bonds = true;
  static constexpr Value nothing_without = Value::modulus;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    add_bond_force(p, c, uncut(p), sums);
  }
};

struct CrackedBondViscosity {
  static constexpr std::string_view name = "CrackedBondViscosity";
  static constexpr ValueSet reads = BondViscosity::reads | ValueSet{Value::crack};
  static constexpr Field writes = Field::force;
  static constexpr bool of_bonds = true;
  static constexpr Value nothing_without = Value::modulus;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    add_bond_viscosity(p, c, uncut(p), sums);
  }
};

/// As BodyContact, and between the faces of a crack where they are closer than they were when it came, of an energy
/// k (|X| (1 - (c_i + c_j) / 2) - r)^2 / 2: c >= 0 is how much shorter than in the reference state the solid was across the
/// crack; what is whole has that energy already, and the faces would gain it once more.
struct CrackedBodyContact {
  static constexpr std::string_view name = "CrackedBodyContact";
  static constexpr ValueSet reads = BodyContact::reads | ValueSet{Value::reference, Value::reference_cell,
                                                                  Value::crack, Value::crack_closing};
  static constexpr Field writes = Field::force;
  static constexpr bool of_bonds = true;
  static constexpr bool across_cracks = true;
  static constexpr Value nothing_without = Value::modulus;
  template <class P, class C>
  static auto overlap(const P& p, const C& c) {
    using V = typename P::V;
    V square = V::zero();
    for (int a = 0; a < P::dim; ++a) square += p.bond.reference[a] * p.bond.reference[a];
    const V shorter = p.template i<Value::crack_closing>() + p.template j<Value::crack_closing>();
    const V part = V(1) - V(static_cast<typename P::Scalar>(0.5)) * shorter;
    const V closed = part * sqrt(square) / V(c.bonds.ratio);
    const V nearer = where_less(closed, V(c.bonds.range), max(closed - p.r, V::zero()));
    const V across = faces(p, 0.8) * p.bond.near;
    return BodyContact::overlap(p, c) +
           where_equal(p.template i<Value::body>(), p.template j<Value::body>(), nearer * across);
  }
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    add_contact(p, c, overlap(p, c), sums);
  }
};

struct CrackedBodyContactEnergy {
  static constexpr std::string_view name = "CrackedBodyContactEnergy";
  static constexpr ValueSet reads = CrackedBodyContact::reads;
  static constexpr Field writes = Field::contact_energy;
  static constexpr bool of_bonds = true;
  static constexpr bool across_cracks = true;
  static constexpr Value nothing_without = Value::modulus;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    add_contact_energy(p, c, CrackedBodyContact::overlap(p, c), sums);
  }
};

/// What models/failure.cpp asks of bonds: how many are as long as lists reach, nearly; how many lead to a particle that is
/// further beyond its strength, of two alike the one in the direction of growing coordinates; and n of what has just failed.
struct CrackSums {
  static constexpr std::string_view name = "CrackSums";
  static constexpr ValueSet reads{Value::reference, Value::reference_cell, Value::body,     Value::modulus,
                                  Value::crack,     Value::crack_distance, Value::overload, Value::failing};
  static constexpr Field writes = Field::crack_sums;
  static constexpr bool of_bonds = true;
  static constexpr Value nothing_without = Value::modulus;
  static constexpr double nearly = 0.95;

  template <class P>
  static auto is_ahead(const P& p) {
    using V = typename P::V;
    V ahead = V::zero();
    for (int a = P::dim - 1; a >= 0; --a) {
      const V x = p.bond.reference[a];
      ahead = where_less(V::zero(), x, V(1)) + where_equal(x, V::zero(), ahead);
    }
    return ahead;
  }
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    using V = typename P::V;
    const V bonded = uncut(p) * p.bond.intact;
    const V own = p.template i<Value::overload>(), other = p.template j<Value::overload>();
    sums.template add<Field::crack_sums>(
        0, where_less(V(static_cast<typename P::Scalar>(nearly) * c.bonds.range), p.r, bonded));
    sums.template add<Field::crack_sums>(
        1, where_less(own, other, bonded) + where_equal(own, other, bonded * is_ahead(p)));
    const V w = p.template j<Value::failing>() * p.bond.weight_of_any;
    V distance = p.template j<Value::crack_distance>();
    for (int a = 0; a < P::dim; ++a) distance -= p.template j<Value::crack>(a) * p.bond.reference[a];
    for (int a = 0; a < P::dim; ++a) {
      const V wm = w * p.template j<Value::crack>(a);
      sums.template add<Field::crack_sums>(2 + a, w * p.bond.reference[a]);
      sums.template add<Field::crack_sums>(2 + P::dim + a, wm * distance);
      for (int b = a; b < P::dim; ++b)
        sums.template add<Field::crack_sums>(2 + 2 * P::dim + symmetric_index(a, b, P::dim),
                                             wm * p.template j<Value::crack>(b));
    }
  }
};

/// 1 for two solids on different faces of a crack, which no bond holds together; else 0.
template <class P>
[[nodiscard]] typename P::V across_crack(const P& p) {
  using V = typename P::V;
  V turned = V::zero();
  for (int a = 0; a < P::dim; ++a) turned += p.template i<Value::crack>(a) * p.template j<Value::crack>(a);
  const V opposite = where_less(turned, V::zero(), faces(p, 0));
  return (V(1) - is_wet(p)) * (V(1) - p.bond.intact * uncut(p)) * opposite;
}

/// As FlowOntoSolids, and what the faces of a crack take of the space between them.
struct CrackedFlowOntoSolids {
  static constexpr std::string_view name = "CrackedFlowOntoSolids";
  static constexpr ValueSet reads =
      FlowOntoSolids::reads | ValueSet{Value::reference, Value::reference_cell, Value::body, Value::crack};
  static constexpr Field writes = Field::flux_sums;
  static constexpr bool only_beside_fluid = true;
  static constexpr Value nothing_without = Value::shears;
  static constexpr bool half_step_back = true;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C&, S& sums) {
    add_flow<Kernel>(p, across_crack(p), sums);
  }
};

/// As WettedPressure, and between the faces of a crack.
struct CrackedWettedPressure {
  static constexpr std::string_view name = "CrackedWettedPressure";
  static constexpr ValueSet reads =
      WettedPressure::reads | ValueSet{Value::reference, Value::reference_cell, Value::body, Value::crack};
  static constexpr Field writes = Field::force;
  static constexpr bool only_beside_fluid = true;
  /// The sum of the pressures where they push, else 0.
  template <class P>
  static typename P::V both(const P& p) {
    using V = typename P::V;
    const V p_i = p.template i<Value::wet_pressure>(), p_j = p.template j<Value::wet_pressure>();
    return (is_wet(p) + across_crack(p)) * (p_i + p_j);
  }
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C&, S& sums) {
    add_pressure(p, both(p), sums);
  }
};

/// What of the stress in a particle these forces bear, which its bonds then do not: half of the moment of each,
///   s_ab = 1/2 sum V_j (p_i + p_j) x_a x_b W'/r,
/// over h. Of a body under the pressure p of the fluid around it bonds bear 0.45 p in the outermost row, with this 0.9 p.
struct BorneByFluid {
  static constexpr std::string_view name = "BorneByFluid";
  static constexpr ValueSet reads = CrackedWettedPressure::reads;
  static constexpr Field writes = Field::borne_by_fluid;
  static constexpr bool only_beside_fluid = true;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C&, S& sums) {
    using V = typename P::V;
    const V s = V(static_cast<typename P::Scalar>(0.5)) * p.template j<Value::volume>() *
                CrackedWettedPressure::both(p) * p.f;
    for (int a = 0; a < P::dim; ++a)
      for (int b = a; b < P::dim; ++b)
        sums.template add<Field::borne_by_fluid>(symmetric_index(a, b, P::dim), s * p.e[a] * p.e[b]);
  }
};

}  // namespace sph
