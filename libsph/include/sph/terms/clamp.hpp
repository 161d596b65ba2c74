// Clamps hold the face of a total-Lagrangian body, half a spacing before their first row, not the row itself: bonds see
// a clamp's particle displaced by the mirror image of what is bonded to it,
//   u_c = -k sum_j W(X_cj) u_j / sum_j W(X_cj),
// k from the depth of c behind the face (models/wall_mirror.hpp), so that a displacement that is 0 on the face and
// linear before it goes on behind. The energy is that of free particles alone. It depends on what is bonded to a clamp
// through u_c too: the force on c, by the same weights, is theirs. With rows that stay where they are a body is longer by 0.6
// spacings, and bends and stretches by so much more.
#pragma once

#include "sph/pairs/pair_values.hpp"

namespace sph {

/// W of a bond in the reference state, without its factor; 0 of all other pairs.
template <class Kernel, class P>
[[nodiscard]] typename P::V bond_kernel(const P& p) {
  using V = typename P::V;
  V square = V::zero();
  for (int a = 0; a < P::dim; ++a) square += p.bond.reference[a] * p.bond.reference[a];
  return p.bond.intact * Kernel::template value<P::dim>(sqrt(square));
}

/// Of a clamp's particle over the free ones that are bonded to it: as wall_sums, displacements for velocities.
struct ClampSums {
  static constexpr std::string_view name = "ClampSums";
  static constexpr ValueSet reads{Value::reference, Value::reference_cell, Value::body, Value::mover};
  static constexpr Field writes = Field::clamp_sums;
  static constexpr bool of_bonds = true;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C&, S& sums) {
    const auto w = bond_kernel<Kernel>(p) * p.template j<Value::mover>();
    sums.template add<Field::clamp_sums>(0, w);
    for (int a = 0; a < P::dim; ++a) {
      sums.template add<Field::clamp_sums>(1 + a, w * p.bond.displacement[a]);
      sums.template add<Field::clamp_sums>(1 + P::dim + a, w * p.bond.reference[a]);
    }
  }
};

/// Of a free particle over the clamps that it is bonded to.
struct ClampReaction {
  static constexpr std::string_view name = "ClampReaction";
  static constexpr ValueSet reads{Value::reference, Value::reference_cell, Value::body, Value::mover,
                                  Value::clamp_reaction};
  static constexpr Field writes = Field::clamp_push;
  static constexpr bool of_bonds = true;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C&, S& sums) {
    using V = typename P::V;
    const V w = bond_kernel<Kernel>(p) * (V(1) - p.template j<Value::mover>());
    for (int a = 0; a < P::dim; ++a)
      sums.template add<Field::clamp_push>(a, w * p.template j<Value::clamp_reaction>(a));
  }
};

}  // namespace sph
