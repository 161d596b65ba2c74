// Viscous forces as a linear operator on any field u of velocities, for the implicit step
// (models/viscosity.cpp): the pair forces of viscosity.hpp with u in place of v, and beside them the
// drag on the particle alone, the operator's diagonal. Symmetric and negative semidefinite, as conjugate
// gradients need it: mirrored velocities of wall particles would not be. A wall particle is given the
// velocity on the straight profile through this particle and the wall's face (wall_profile.hpp), a drag on particle i
// only.
#pragma once

#include "sph/pairs/pair_values.hpp"
#include "sph/terms/viscosity.hpp"
#include "sph/terms/wall_profile.hpp"

namespace sph {

/// 2 V_i V_j eta_ij |f| of movers; of walls with the fluid's own viscosity, times the profile.
template <class P>
typename P::V viscous_drag(const P& p) {
  using V = typename P::V;
  const V mover = p.template j<Value::mover>(), own = p.template i<Value::viscosity>();
  const V eta = where_equal(mover, V(1), mean_viscosity(p)) +
                where_equal(mover, V::zero(), (own + own) * wall_profile(p).share());
  return -(p.template i<Value::volume>() * p.template j<Value::volume>() * eta * p.f);
}

inline constexpr ValueSet viscous_operator_reads{Value::volume, Value::viscosity, Value::direction,
                                                 Value::mover, Value::wall_slope};

struct ViscousOperator {
  static constexpr std::string_view name = "ViscousOperator";
  static constexpr ValueSet reads = viscous_operator_reads;
  static constexpr Field writes = Field::viscous_sums;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    using V = typename P::V;
    const V drag = viscous_drag(p) * V(c.viscous.laplacian);
    for (int k = 0; k < P::dim; ++k)
      sums.template add<Field::viscous_sums>(
          k, drag * (p.template j<Value::direction>(k) - p.template i<Value::direction>(k)));
    sums.template add<Field::viscous_sums>(P::dim, drag);
  }
};

struct SymmetricViscousOperator {
  static constexpr std::string_view name = "SymmetricViscousOperator";
  static constexpr ValueSet reads = viscous_operator_reads;
  static constexpr Field writes = Field::viscous_sums;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    using V = typename P::V;
    using T = typename P::Scalar;
    V stretch = V::zero();
    for (int k = 0; k < P::dim; ++k)
      stretch += (p.template j<Value::direction>(k) - p.template i<Value::direction>(k)) * p.e[k];
    const V drag = viscous_drag(p) * V(c.viscous.symmetric);
    for (int k = 0; k < P::dim; ++k) sums.template add<Field::viscous_sums>(k, drag * stretch * p.e[k]);
    // The mean over the directions: the diagonal is used to precondition alone.
    sums.template add<Field::viscous_sums>(P::dim, drag * p.r2 * V(static_cast<T>(1.0 / P::dim)));
  }
};

}  // namespace sph
