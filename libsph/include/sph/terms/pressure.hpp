// Pressure force in volume form, exactly antisymmetric: F_ij = -V_i V_j (p_i + p_j) grad_i W
// (Colagrossi & Landrini 2003; Grenier et al. 2009).
#pragma once

#include "sph/pairs/pair_values.hpp"

namespace sph {

struct Pressure {
  static constexpr std::string_view name = "Pressure";
  static constexpr ValueSet reads{Value::volume, Value::pressure};
  static constexpr Field writes = Field::force;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C&, S& sums) {
    const auto s = p.template i<Value::volume>() * p.template j<Value::volume>() *
                   (p.template i<Value::pressure>() + p.template j<Value::pressure>()) * p.f;
    for (int a = 0; a < P::dim; ++a) sums.template add<Field::force>(a, s * p.e[a]);
  }
};

/// Where fluids of different density meet, weighted so that grad p / rho, which is continuous there, is what
/// is smoothed: F_ij = -2 V_i V_j (rho_j p_i + rho_i p_j) / (rho_i + rho_j) grad_i W (Hu & Adams 2007, eq.
/// 11). With plain sums the light fluid's particles only come to rest displaced. A wall is as dense as what
/// touches it.
struct WeightedPressure {
  static constexpr std::string_view name = "WeightedPressure";
  static constexpr ValueSet reads{Value::volume, Value::density, Value::mover, Value::heavy,
                                  Value::pressures};
  static constexpr Field writes = Field::force;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C&, S& sums) {
    using V = typename P::V;
    const V rho_i = p.template i<Value::density>(), mover = p.template j<Value::mover>();
    const V heavy = p.template i<Value::heavy>();
    const V rho_j =
        where_equal(mover, V(1), p.template j<Value::density>()) + where_equal(mover, V::zero(), rho_i);
    const V p_j = where_equal(heavy, V::zero(), p.template j<Value::pressures>(0)) +
                  where_equal(heavy, V(1), p.template j<Value::pressures>(1));
    const V between = (rho_j * p.template i<Value::pressures>() + rho_i * p_j) / (rho_i + rho_j);
    const V s = p.template i<Value::volume>() * p.template j<Value::volume>() * (between + between) * p.f;
    for (int a = 0; a < P::dim; ++a) sums.template add<Field::force>(a, s * p.e[a]);
  }
};

}  // namespace sph
