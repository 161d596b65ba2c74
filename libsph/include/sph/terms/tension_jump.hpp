// Surface tension as the jump that it makes in the pressure: of a pair across the interface each particle
// takes the other's pressure with sigma kappa added, so that what is summed is continuous,
//   F_i = -s_i V_i V_j w_i sigma (kappa_i + kappa_j) / 2 grad_i W,   s_i = 1 in the first fluid, else -1
// (the continuum surface force of Brackbill et al. 1992 with the very gradient of the pressure sum). Where
// kappa is constant it balances the pressure exactly, and nothing pulls along the interface. Both particles
// of a pair are pushed the same way: no force between two particles can be a jump. Momentum stays as far as
// the integral of kappa n over a closed interface is 0, to what the sums leave of it. w_i = 1, or with
// pressures weighted by density 2 rho_i / (rho_i + rho_j) (terms/pressure.hpp). Antisymmetric, beside it: a
// dashpot across the interface, along the line of centres, since at the scale of the particles nothing else
// resists the interface's motion; and for all pairs a constant pressure that keeps particles evenly spread
// where theirs is negative, -2 V_i V_j p_b grad_i W.
#pragma once

#include "sph/pairs/pair_values.hpp"

namespace sph {

template <bool Weighted>
struct JumpOfPressure {
  static constexpr ValueSet reads{Value::volume,      Value::velocity, Value::density,
                                  Value::sound_speed, Value::side,     Value::capillary_pressure};
  static constexpr Field writes = Field::force;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    using V = typename P::V;
    const V side = p.template i<Value::side>();
    const V rho_i = p.template i<Value::density>(), rho_j = p.template j<Value::density>();
    const V inverse = V(1) / (rho_i + rho_j), twice = rho_i + rho_i;
    V jump = V(typename P::Scalar(0.5)) * side *
             (p.template i<Value::capillary_pressure>() + p.template j<Value::capillary_pressure>());
    if constexpr (Weighted) jump = jump * (twice * inverse);
    V approach = V::zero();
    for (int k = 0; k < P::dim; ++k)
      approach += (p.template j<Value::velocity>(k) - p.template i<Value::velocity>(k)) * p.e[k];
    const V sound = min(p.template i<Value::sound_speed>(), p.template j<Value::sound_speed>());
    const V impedance = twice * rho_j * inverse * sound;
    const V damping =
        V(c.jump.damping) * impedance * (approach / max(p.r2, V(static_cast<typename P::Scalar>(1e-30))));
    const V across = where_equal(side * p.template j<Value::side>(), V(-1), jump - damping);
    const V s = p.template i<Value::volume>() * p.template j<Value::volume>() *
                (V(c.jump.background_pressure) + across) * p.f;
    for (int a = 0; a < P::dim; ++a) sums.template add<Field::force>(a, s * p.e[a]);
  }
};

struct TensionJump : JumpOfPressure<false> {
  static constexpr std::string_view name = "TensionJump";
};
struct WeightedTensionJump : JumpOfPressure<true> {
  static constexpr std::string_view name = "WeightedTensionJump";
};

}  // namespace sph
