// What exchanges between pairs have in common: what flows to a particle is 2 V_i V_j F k_ij times a difference, F = -W'/r over
// its moment on the lattice, antisymmetric to the bit; matter that flows takes the mean velocity of the pair along, and
// the heat of where it comes from. The harmonic mean keeps the flux where a coefficient jumps (Cleary & Monaghan 1999,
// eq. 29), and is 0 where one of both has none.
#pragma once

#include "sph/terms/harmonic_mean.hpp"

namespace sph {

/// 2 V_i V_j F k for a mean of coefficients over h.
template <class P, class C>
[[nodiscard, gnu::always_inline]] inline typename P::V exchange_rate(const P& p, const C& c,
                                                                     typename P::V twice_mean) {
  using V = typename P::V;
  return -(p.template i<Value::volume>() * p.template j<Value::volume>() * twice_mean *
           (V(c.viscous.laplacian) * p.f));
}

/// Of a coefficient that both have; always in double precision.
template <Value of, class P>
[[nodiscard, gnu::always_inline]] inline typename P::V exchange_mean(const P& p) {
  return twice_harmonic_mean(p.template i<of>(), p.template j<of>(),
                             typename P::V(static_cast<typename P::Scalar>(1e-300)));
}

/// Mass that flows to i [kg/s], and the momentum that it brings.
template <class P, class S>
[[gnu::always_inline]] inline void add_matter(const P& p, typename P::V flow, S& sums) {
  const typename P::V half(static_cast<typename P::Scalar>(0.5));
  sums.template add<Field::gas_gain>(0, flow);
  for (int a = 0; a < P::dim; ++a)
    sums.template add<Field::gas_gain>(
        1 + a, half * flow * (p.template j<Value::velocity>(a) - p.template i<Value::velocity>(a)));
}

/// c_p T of where it comes from that flows to i where `towards` is positive.
template <class P>
[[nodiscard, gnu::always_inline]] inline typename P::V heat_upstream(const P& p, typename P::V towards) {
  using V = typename P::V;
  return where_less(V::zero(), towards, p.template j<Value::sensible_heat>()) +
         where_less(towards, V::zero(), p.template i<Value::sensible_heat>());
}

}  // namespace sph
