// An ideal gas knows the volume of a particle from where its neighbours are, V_i = 1 / sum_j W_ij(h_i), and
// not from an integral of div v: of what starts with a jump the latter never forgets the first steps, and the
// momentum equation sees twice its error as pressure (5 % at the contact of Sod's tube). The kernel is as
// wide as the particle is large, h_i^D = (h / spacing)^D V_i: a particle that has lost its neighbours has
// lost its volume too (it cannot fall below 1 / W(0)) and keeps the heat that should have driven them away.
// Then the pressure force is the gradient of the internal energy (Springel & Hernquist 2002, eq. 18, with
// numbers in the place of masses),
//   F_ij = -(p_i V_i^2 / Omega_i grad_i W_ij(h_i) + p_j V_j^2 / Omega_j grad_i W_ij(h_j)),
// and energy is conserved whatever the spacing. Not so beside walls, where it is in the mean. Walls keep
// their spacing when the gas at them is compressed: they fill a share s of a kernel that is there not less
// than h wide, V_i = (1 - s) / sum_j W_ij over the gas alone, and F_iw = -V_i V_w (p_i + p_w) grad_i W.
#pragma once

#include "sph/pairs/pair_values.hpp"

namespace sph {

/// Sum of W over the gas, and of V W over walls, both without the kernel's factor and that of its width.
struct NumberDensity {
  static constexpr std::string_view name = "NumberDensity";
  static constexpr ValueSet reads{Value::volume, Value::mover, Value::width};
  static constexpr Field writes = Field::number_density;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C&, S& sums) {
    using V = typename P::V;
    const V mover = p.template j<Value::mover>();
    const V of_gas = where_equal(mover, V(1), Kernel::template value<P::dim>(p.r * p.width.inverse));
    // Lists are padded with the particle itself.
    sums.template add<Field::number_density>(0, of_gas - where_equal(p.r2, V::zero(), of_gas));
    const V w = Kernel::template value<P::dim>(p.r * p.width.inverse_at_wall);
    sums.template add<Field::number_density>(
        1, where_equal(mover, V::zero(), w * p.template j<Value::volume>()));
  }
};

/// What the sums of NumberDensity change by when the kernel grows wider, and the moments of which the
/// gradient of the velocity is made, exact where it is uniform.
struct GasMoments {
  static constexpr std::string_view name = "GasMoments";
  static constexpr ValueSet reads{Value::volume, Value::mover, Value::width, Value::velocity};
  static constexpr Field writes = Field::gas_moments;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C&, S& sums) {
    using V = typename P::V;
    constexpr int symmetric = P::dim * (P::dim + 1) / 2;
    const V mover = p.template j<Value::mover>();
    const V q = p.r * p.width.inverse, q_wall = p.r * p.width.inverse_at_wall;
    const V stretch = q * Kernel::template slope<P::dim>(q);
    const V of_walls = q_wall * Kernel::template slope<P::dim>(q_wall) * p.template j<Value::volume>();
    sums.template add<Field::gas_moments>(0, where_equal(mover, V(1), stretch));
    sums.template add<Field::gas_moments>(1, where_equal(mover, V::zero(), of_walls));
    const V w = where_equal(mover, V(1), Kernel::template value<P::dim>(q));
    for (int a = 0, k = 2; a < P::dim; ++a)
      for (int b = a; b < P::dim; ++b, ++k) sums.template add<Field::gas_moments>(k, w * p.e[a] * p.e[b]);
    for (int a = 0, k = 2 + symmetric; a < P::dim; ++a) {
      const V dv = w * (p.template j<Value::velocity>(a) - p.template i<Value::velocity>(a));
      for (int b = 0; b < P::dim; ++b, ++k) sums.template add<Field::gas_moments>(k, dv * p.e[b]);
    }
  }
};

struct GasPressure {
  static constexpr std::string_view name = "GasPressure";
  static constexpr ValueSet reads{Value::volume, Value::pressure, Value::mover, Value::width,
                                  Value::kernel_correction};
  static constexpr Field writes = Field::force;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C&, S& sums) {
    using V = typename P::V;
    const V v_i = p.template i<Value::volume>(), v_j = p.template j<Value::volume>();
    const V p_i = p.template i<Value::pressure>(), p_j = p.template j<Value::pressure>();
    const V mover = p.template j<Value::mover>();
    const V of_i = v_i * v_i * p_i * p.template i<Value::kernel_correction>() * p.width.f_i;
    const V of_j = v_j * v_j * p_j * p.template j<Value::kernel_correction>() * p.width.f_j;
    const V s = where_equal(mover, V(1), of_i + of_j) +
                where_equal(mover, V::zero(), v_i * v_j * (p_i + p_j) * p.width.f_at_wall);
    for (int a = 0; a < P::dim; ++a) sums.template add<Field::force>(a, s * p.e[a]);
  }
};

}  // namespace sph
