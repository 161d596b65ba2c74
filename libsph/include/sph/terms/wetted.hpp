// Fluids beside total-Lagrangian solids. To a fluid a body is a wall that moves (Adami et al. 2012): its particles
// have the pressure and the mirrored velocity of the fluid beside them, extrapolated in the body's own frame, where
// grad p = rho (g - a) with a the body's acceleration (eq. 27; models/wetted.cpp). What the fluid feels the body feels in
// the opposite sense, pair by pair. Pairs without a fluid have no such force: bodies have bonds and contacts
// (terms/bonds.hpp, body_contact.hpp).
//
// The pressure of a body's particle b is a mean over the fluid's, p_b = sum_k a_bk p_k + head, a_bk = W_bk / sum W, and the
// work that it does must be that of compression. The fluid's continuity sees of a flow that ends at a wall only as much as
// fluid fills its kernel. What is missing is what the sums at the wall's particles see, and the fluid whose pressure they
// have gets it, in the same shares:
//   div v_k += 1/V_k sum_b a_bk V_b div v_b,   div v_b = sum_i V_i (v_i - v_b).grad_b W.
// Without it a light cylinder that rises for a second gains 12 % of its energy.
#pragma once

#include "sph/terms/artificial_viscosity.hpp"
#include "sph/terms/head.hpp"
#include "sph/terms/viscosity.hpp"
#include "sph/terms/wall.hpp"

namespace sph {

/// 1 where i or j is a fluid, else 0.
template <class P>
[[nodiscard]] typename P::V is_wet(const P& p) {
  return typename P::V(1) - p.template i<Value::shears>() * p.template j<Value::shears>();
}

/// As WallExtrapolation, for bodies and walls.
struct WettedExtrapolation {
  static constexpr std::string_view name = "WettedExtrapolation";
  static constexpr ValueSet reads{Value::velocity, Value::pressure, Value::weight,
                                  Value::density,  Value::shears,   Value::own_head};
  static constexpr Field writes = Field::wall_sums;
  static constexpr bool only_beside_fluid = true;
  static constexpr Value nothing_without = Value::shears;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    using V = typename P::V;
    V push = V::zero();
    for (int k = 0; k < P::dim; ++k) push += p.template i<Value::own_head>(k) * p.e[k];
    const V rise = p.template j<Value::weight>() * head(p, c) + p.template j<Value::density>() * push;
    extrapolate<Kernel>(p, V(1) - p.template j<Value::shears>(), rise, sums);
  }
};

/// `more`: of a solid partner.
template <class Kernel, class P, class S>
void add_flow(const P& p, typename P::V more, S& sums) {
  using V = typename P::V;
  const V fluid = V(1) - p.template j<Value::shears>();
  V t = V::zero();
  for (int k = 0; k < P::dim; ++k)
    t += (p.template i<Value::velocity>(k) - p.template j<Value::velocity>(k)) * p.e[k];
  sums.template add<Field::flux_sums>(0, fluid * Kernel::template value<P::dim>(p.r));
  sums.template add<Field::flux_sums>(1, (fluid + more) * p.template j<Value::volume>() * p.f * t);
}

/// What flows onto a body or wall, div v_b, and the sum of W.
struct FlowOntoSolids {
  static constexpr std::string_view name = "FlowOntoSolids";
  static constexpr ValueSet reads{Value::velocity, Value::volume, Value::shears};
  static constexpr Field writes = Field::flux_sums;
  static constexpr bool only_beside_fluid = true;
  static constexpr Value nothing_without = Value::shears;
  static constexpr bool half_step_back = true;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C&, S& sums) {
    add_flow<Kernel>(p, P::V::zero(), sums);
  }
};

/// The fluid's share of that; beside Divergence.
struct FlowFromSolids {
  static constexpr std::string_view name = "FlowFromSolids";
  static constexpr ValueSet reads{Value::velocity, Value::volume, Value::flux};
  static constexpr Field writes = Field::divergence;
  static constexpr bool of_fluids = true;
  static constexpr bool half_step_back = true;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C&, S& sums) {
    using V = typename P::V;
    // Lists are padded with the particle itself, which may be a solid's.
    const V share = where_less(V::zero(), p.r, Kernel::template value<P::dim>(p.r));
    sums.template add<Field::divergence>(0,
                                         p.template j<Value::flux>() * share / p.template i<Value::volume>());
  }
};

/// The force of pairs with this sum of pressures.
template <class P, class S>
void add_pressure(const P& p, typename P::V both, S& sums) {
  const auto s = p.template i<Value::volume>() * p.template j<Value::volume>() * both * p.f;
  for (int a = 0; a < P::dim; ++a) sums.template add<Field::force>(a, s * p.e[a]);
}

struct WettedPressure {
  static constexpr std::string_view name = "WettedPressure";
  static constexpr ValueSet reads{Value::volume, Value::wet_pressure, Value::shears};
  static constexpr Field writes = Field::force;
  static constexpr bool only_beside_fluid = true;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C&, S& sums) {
    add_pressure(p, is_wet(p) * (p.template i<Value::wet_pressure>() + p.template j<Value::wet_pressure>()),
                 sums);
  }
};

/// Bodies and walls are as viscous as the fluid: where one is fluid, its viscosity; of two fluids the harmonic mean.
template <class P>
[[nodiscard]] typename P::V wet_viscosity(const P& p) {
  using V = typename P::V;
  const V i = p.template i<Value::viscosity>(), j = p.template j<Value::viscosity>();
  const V a = i + p.template i<Value::shears>() * (j - i), b = j + p.template j<Value::shears>() * (i - j);
  return is_wet(p) * twice_harmonic_mean(a, b, V(static_cast<typename P::Scalar>(1e-30)));
}

struct WettedViscosity {
  static constexpr std::string_view name = "WettedViscosity";
  static constexpr ValueSet reads{Value::volume, Value::wet_velocity, Value::viscosity, Value::shears};
  static constexpr Field writes = Field::force;
  static constexpr bool only_beside_fluid = true;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    add_laplacian<Value::wet_velocity>(p, c, wet_viscosity(p), sums);
  }
};

struct WettedSymmetricViscosity {
  static constexpr std::string_view name = "WettedSymmetricViscosity";
  static constexpr ValueSet reads = WettedViscosity::reads;
  static constexpr Field writes = Field::force;
  static constexpr bool only_beside_fluid = true;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    add_symmetric<Value::wet_velocity>(p, c, wet_viscosity(p), sums);
  }
};

/// Between fluids alone: a body that sheds no sound needs none.
struct WettedArtificialViscosity {
  static constexpr std::string_view name = "WettedArtificialViscosity";
  static constexpr ValueSet reads = ArtificialViscosity::reads | ValueSet{Value::shears};
  static constexpr Field writes = Field::force;
  static constexpr bool only_beside_fluid = true;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    using V = typename P::V;
    const V both = (V(1) - p.template i<Value::shears>()) * (V(1) - p.template j<Value::shears>());
    const V s = both * artificial_push(p, c);
    for (int a = 0; a < P::dim; ++a) sums.template add<Field::force>(a, -(s * p.e[a]));
  }
};

}  // namespace sph
