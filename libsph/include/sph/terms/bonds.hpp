// Total-Lagrangian elasticity: sums over the bonds of the reference state, that is over the pairs of one body
// whose reference positions X lie within the support of each other, however they move. With
// w_ij = V_j (-W'(|X_ij|)) / |X_ij| >= 0, constant in time,
//   A = sum w X X,   B = sum w u X,   H = B A^-1 = F - 1   (Bonet & Lok 1999, corrected gradient)
// is the least-squares fit of the displacements u, so that sum w (u - H X) X = 0. The energy
//   sum_i V_i [ psi(F_i) + c/2 sum_j w_ij |u_ij - H_i X_ij|^2 ]
// has its hourglass part from Silling (2017, eq. 43), and its exact derivative is the pair force
//   f_ij = V_i V_j (-W'/|X|) [ (M_i + M_j) X_ij + (c_i + c_j) u_ij ],   M = P A^-1 - c H
// So linear and angular momentum and energy are conserved, and affine motion feels no hourglass force. Particles of
// clamps have no energy, M = c = 0, and are seen where terms/clamp.hpp has them.
#pragma once

#include "sph/pairs/pair_values.hpp"

namespace sph {

/// `share`: of the bond, 1 but for those that a crack cuts (terms/crack.hpp).
template <class P, class S>
void add_deformation(const P& p, typename P::V share, S& sums) {
  using V = typename P::V;
  const V w = p.template j<Value::reference_volume>() * (share * p.bond.weight);
  V square = V::zero();
  for (int a = 0; a < P::dim; ++a) square += p.bond.displacement[a] * p.bond.displacement[a];
  sums.template add<Field::deformation>(0, share * p.bond.intact);
  sums.template add<Field::deformation>(1, w * square);
  for (int a = 0; a < P::dim; ++a) {
    const V wx = w * p.bond.reference[a], wu = w * p.bond.displacement[a];
    for (int b = a; b < P::dim; ++b)
      sums.template add<Field::deformation>(2 + symmetric_index(a, b, P::dim), wx * p.bond.reference[b]);
    for (int b = 0; b < P::dim; ++b)
      sums.template add<Field::deformation>(2 + P::dim * (P::dim + 1) / 2 + a * P::dim + b,
                                            wu * p.bond.reference[b]);
  }
}

/// Number of bonds, sum w u.u, A (symmetric), B (by rows), the last three less their common scale.
struct Deformation {
  static constexpr std::string_view name = "Deformation";
  static constexpr ValueSet reads{Value::reference, Value::reference_cell, Value::reference_volume,
                                  Value::body,      Value::modulus,        Value::clamp_shift};
  static constexpr Field writes = Field::deformation;
  static constexpr bool of_bonds = true;
  static constexpr Value nothing_without = Value::modulus;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C&, S& sums) {
    add_deformation(p, typename P::V(1), sums);
  }
};

template <class P, class C, class S>
void add_bond_force(const P& p, const C& c, typename P::V share, S& sums) {
  using V = typename P::V;
  const V s = p.template i<Value::reference_volume>() * p.template j<Value::reference_volume>() *
              (V(c.bonds.force) * (share * p.bond.weight));
  const V stiffness = p.template i<Value::hourglass>() + p.template j<Value::hourglass>();
  for (int a = 0; a < P::dim; ++a) {
    V t = stiffness * p.bond.displacement[a];
    for (int b = 0; b < P::dim; ++b) {
      const int ab = a * P::dim + b;
      t +=
          (p.template i<Value::bond_stress>(ab) + p.template j<Value::bond_stress>(ab)) * p.bond.reference[b];
    }
    sums.template add<Field::force>(a, s * t);
  }
}

struct BondForce {
  static constexpr std::string_view name = "BondForce";
  static constexpr ValueSet reads{Value::reference, Value::reference_cell, Value::reference_volume,
                                  Value::body,      Value::bond_stress,    Value::modulus,
                                  Value::hourglass, Value::clamp_shift};
  static constexpr Field writes = Field::force;
  static constexpr bool of_bonds = true;
  static constexpr Value nothing_without = Value::modulus;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    add_bond_force(p, c, typename P::V(1), sums);
  }
};

/// Central, so that angular momentum stays: f_ij = 2 (D+2) eta V_i V_j (-W'/|X|) (v_ij.e) e / |e|^2, the form
/// of Monaghan (2005, eq. 8.8) on bonds.
template <class P, class C, class S>
void add_bond_viscosity(const P& p, const C& c, typename P::V share, S& sums) {
  using V = typename P::V;
  V closing = V::zero();
  for (int a = 0; a < P::dim; ++a)
    closing += (p.template j<Value::velocity>(a) - p.template i<Value::velocity>(a)) * p.e[a];
  const V eta = V(static_cast<typename P::Scalar>(P::dim + 2)) *
                (p.template i<Value::viscosity>() + p.template j<Value::viscosity>());
  const V s = p.template i<Value::reference_volume>() * p.template j<Value::reference_volume>() *
              (V(c.bonds.viscosity) * (share * p.bond.weight));
  const V t = s * eta * (closing / max(p.r2, V(static_cast<typename P::Scalar>(1e-30))));
  for (int a = 0; a < P::dim; ++a) sums.template add<Field::force>(a, t * p.e[a]);
}

struct BondViscosity {
  static constexpr std::string_view name = "BondViscosity";
  static constexpr ValueSet reads{Value::reference, Value::reference_cell, Value::reference_volume,
                                  Value::body,      Value::velocity,       Value::viscosity,
                                  Value::modulus};
  static constexpr Field writes = Field::force;
  static constexpr bool of_bonds = true;
  static constexpr Value nothing_without = Value::modulus;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    add_bond_viscosity(p, c, typename P::V(1), sums);
  }
};

}  // namespace sph
