// XSPH: particles drift with their velocity and a part eps of how it differs from their neighbours',
// dx_i/dt = v_i + eps sum_j m_j / rho_ij (v_j - v_i) W_ij, rho_ij the mean of the two densities (Monaghan
// 1989, eq. 2.6). Over movers: m_i times the term is antisymmetric, so that the centre of mass moves with the
// momentum; a common velocity drifts nobody.
#pragma once

#include "sph/pairs/pair_values.hpp"

namespace sph {

struct Xsph {
  static constexpr std::string_view name = "Xsph", word = "xsph";
  static constexpr double most = 1;
  static constexpr std::string_view sentence =
      "eps of XSPH: particles drift with a part eps of how their neighbours' velocity differs from theirs.";
  static constexpr Effect effect = Effect::drift;
  static constexpr ValueSet reads{Value::velocity, Value::volume, Value::density, Value::mover};
  static constexpr Field writes = Field::added;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C&, S& sums) {
    using V = typename P::V;
    const V rho_j = p.template j<Value::density>();
    const V share = p.template j<Value::mover>() * p.template j<Value::volume>() *
                    ((rho_j + rho_j) / (p.template i<Value::density>() + rho_j)) *
                    Kernel::template value<P::dim>(p.r);
    for (int a = 0; a < P::dim; ++a)
      sums.template add<Field::added>(
          a, share * (p.template j<Value::velocity>(a) - p.template i<Value::velocity>(a)));
  }
};

}  // namespace sph
