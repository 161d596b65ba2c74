// Heat of viscous friction: what the pair forces of viscosity.hpp take from the motion, half to each of two movers,
//   dQ_i/dt = sum_j eta_ij V_i V_j |f| |v_i - v_j|^2                      of the Laplacian form
//           = sum_j (D + 2) eta_ij V_i V_j |f| (v_ij.x_ij)^2 / m          of the symmetric one
// so that it is never negative; all of the friction on a wall, at rest against its profile (wall_profile.hpp), heats the
// particle beside it. Walls that slip rub nothing. In double precision: budgets count it.
#pragma once

#include "sph/terms/viscous_operator.hpp"

namespace sph {

/// viscous_drag() times the particle's part of it.
template <class P>
typename P::V heating_drag(const P& p) {
  using V = typename P::V;
  const V mover = p.template j<Value::mover>();
  const V part =
      where_equal(mover, V(1), V(0.5)) + where_equal(mover, V::zero(), p.template j<Value::grip>());
  return viscous_drag(p) * part;
}

inline constexpr ValueSet viscous_heat_reads{Value::volume, Value::viscosity,  Value::velocity,
                                             Value::mover,  Value::wall_slope, Value::grip};

struct ViscousHeat {
  static constexpr std::string_view name = "ViscousHeat";
  static constexpr bool always_double = true;
  static constexpr ValueSet reads = viscous_heat_reads;
  static constexpr Field writes = Field::viscous_heat;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    using V = typename P::V;
    V square = V::zero();
    for (int k = 0; k < P::dim; ++k) {
      const V dv = p.template i<Value::velocity>(k) - p.template j<Value::velocity>(k);
      square += dv * dv;
    }
    sums.template add<Field::viscous_heat>(0, heating_drag(p) * V(c.viscous.laplacian) * square);
  }
};

struct SymmetricViscousHeat {
  static constexpr std::string_view name = "SymmetricViscousHeat";
  static constexpr bool always_double = true;
  static constexpr ValueSet reads = viscous_heat_reads;
  static constexpr Field writes = Field::viscous_heat;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    using V = typename P::V;
    V stretch = V::zero();
    for (int k = 0; k < P::dim; ++k)
      stretch += (p.template i<Value::velocity>(k) - p.template j<Value::velocity>(k)) * p.e[k];
    sums.template add<Field::viscous_heat>(0, heating_drag(p) * V(c.viscous.symmetric) * (stretch * stretch));
  }
};

}  // namespace sph
