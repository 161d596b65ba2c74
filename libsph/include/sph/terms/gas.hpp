// An ideal gas knows the volume of a particle from where its neighbours are, V_i = 1 / sum_j W_ij, and not
// from an integral of div v: of what starts with a jump the latter never forgets the first steps, and the
// momentum equation sees twice its error as pressure (5 % at the contact of Sod's tube). Then the pressure
// force is the gradient of the internal energy, F_ij = -(p_i V_i^2 + p_j V_j^2) grad_i W (Hu & Adams 2006,
// eq. 14), and energy is conserved whatever the spacing. Not so beside walls, where it is in the mean. Walls
// keep their spacing when the gas at them is compressed: they fill a share s of the kernel, V_i = (1 - s) /
// sum_j W_ij over the gas alone, and F_iw = -V_i V_w (p_i + p_w) grad_i W.
#pragma once

#include "sph/pair_rows.hpp"

namespace sph {

/// Sum of W over the gas, and of V W over walls, both without the kernel's factor.
struct NumberDensity {
  static constexpr Term term = Term::number_density;
  static constexpr ValueSet reads{Value::volume, Value::mover};
  static constexpr Field writes = Field::number_density;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C&, S& sums) {
    using V = typename P::V;
    const V w = Kernel::template value<P::dim>(p.r), mover = p.template j<Value::mover>();
    const V of_gas = where_equal(mover, V(1), w);
    // Lists are padded with the particle itself.
    sums.template add<Field::number_density>(0, of_gas - where_equal(p.r2, V::zero(), of_gas));
    sums.template add<Field::number_density>(
        1, where_equal(mover, V::zero(), w * p.template j<Value::volume>()));
  }
};

struct GasPressure {
  static constexpr Term term = Term::gas_pressure;
  static constexpr ValueSet reads{Value::volume, Value::pressure, Value::mover};
  static constexpr Field writes = Field::force;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C&, S& sums) {
    using V = typename P::V;
    const V v_i = p.template i<Value::volume>(), v_j = p.template j<Value::volume>();
    const V p_i = p.template i<Value::pressure>(), p_j = p.template j<Value::pressure>();
    const V mover = p.template j<Value::mover>();
    const V s = (where_equal(mover, V(1), v_i * v_i * p_i + v_j * v_j * p_j) +
                 where_equal(mover, V::zero(), v_i * v_j * (p_i + p_j))) *
                p.f;
    for (int a = 0; a < P::dim; ++a) sums.template add<Field::force>(a, s * p.e[a]);
  }
};

}  // namespace sph
