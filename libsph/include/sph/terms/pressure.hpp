// Pressure force in volume form, exactly antisymmetric: F_ij = -V_i V_j (p_i + p_j) grad_i W
// (Colagrossi & Landrini 2003; Grenier et al. 2009).
#pragma once

#include "sph/pair_rows.hpp"

namespace sph {

struct Pressure {
  static constexpr Term term = Term::pressure;
  static constexpr ValueSet reads{Value::volume, Value::pressure};
  static constexpr Field writes = Field::force;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C&, S& sums) {
    const auto s = p.template i<Value::volume>() * p.template j<Value::volume>() *
                   (p.template i<Value::pressure>() + p.template j<Value::pressure>()) * p.f;
    for (int a = 0; a < P::dim; ++a) sums.template add<Field::force>(a, s * p.e[a]);
  }
};

}  // namespace sph
