// Conduction of heat, exchanged pair by pair: what one particle gains its partner loses, to the bit,
//   m_i dH_i/dt = sum_j 2 V_i V_j k_ij F_ij (T_j - T_i),   F = -W'/r over its moment on the lattice,
// with k_ij the harmonic mean, which keeps the flux where the conductivity jumps (Cleary & Monaghan 1999, eq. 29; the
// arithmetic mean is 7 % off at 1 : 1000). Walls have no heat of their own. One that keeps a temperature T_w gives a
// particle what the straight profile between them says (wall_profile.hpp); one with a flux q gives 2 q |S| V_i, S the
// gradient of the walls' share of the kernel along the normal, which over all rows is one half. One that takes heat
// from its face by a coefficient or by radiation does so with
//   q = q_0 - h_c T_f - e sigma T_f^4 = k (T_f - T_i) / d,   q_0 = h_c T_w + e sigma T_a^4,
// in series with the way d to the face (Incropera et al. 2007, eqs. 1.3 and 1.7), so that no coefficient asks for a
// shorter time step than a kept temperature does. Always in double precision: sums of heat must not lose what single
// precision rounds.
#pragma once

#include "sph/terms/exchange_rule.hpp"
#include "sph/terms/wall_profile.hpp"

namespace sph {

template <class P, class C>
[[nodiscard, gnu::always_inline]] inline typename P::V conductance(const P& p, const C& c) {
  return exchange_rate(p, c, exchange_mean<Value::conductivity>(p));
}

struct Conduction {
  static constexpr std::string_view name = "Conduction";
  static constexpr bool always_double = true;
  static constexpr ValueSet reads{Value::volume, Value::temperature, Value::conductivity};
  static constexpr Field writes = Field::heat_gain;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    sums.template add<Field::heat_gain>(
        0, conductance(p, c) * (p.template j<Value::temperature>() - p.template i<Value::temperature>()));
  }
};

/// The same of any field of temperatures, for the implicit step (models/conduction_solver.hpp).
struct ConductionOperator {
  static constexpr std::string_view name = "ConductionOperator";
  static constexpr bool always_double = true;
  static constexpr ValueSet reads{Value::volume, Value::trial, Value::conductivity};
  static constexpr Field writes = Field::exchange_sums;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    const typename P::V rate = conductance(p, c);
    sums.template add<Field::exchange_sums>(
        0, rate * (p.template j<Value::trial>() - p.template i<Value::trial>()));
    sums.template add<Field::exchange_sums>(1, rate);
  }
};

/// Into a particle through the face of a wall.
template <class V>
struct FaceFlux {
  V given;  ///< [W/m^2]
  V slope;  ///< how much less if the particle were 1 K warmer [W/m^2/K]
};

/// Heat that walls keep or give.
template <class P, class C, class S>
void add_heat_of_wall(const P& p, const C& c, const WallProfile<typename P::V>& profile,
                      const FaceFlux<typename P::V>& flux, S& sums) {
  using V = typename P::V;
  // Between walls so near that there is no normal they give all of their flux.
  const V way = profile.across / max(sqrt(profile.steepness), V(static_cast<typename P::Scalar>(1e-300))) +
                where_equal(profile.steepness, V::zero(), p.r);
  const V weight = p.template i<Value::volume>() * p.template j<Value::volume>() * p.f;
  const V own = p.template i<Value::conductivity>();
  const V keeps = (own + own) * profile.share() * V(c.viscous.laplacian) * p.template j<Value::wall_warmth>();
  const V kept = keeps * (p.template i<Value::temperature>() - p.template j<Value::temperature>());
  sums.template add<Field::wall_heat>(0, weight * (kept - flux.given * (way + way)));
  sums.template add<Field::wall_heat>(1, -(weight * (keeps + flux.slope * (way + way))));
}

struct WallConduction {
  static constexpr std::string_view name = "WallConduction";
  static constexpr bool always_double = true, over_walls = true;
  static constexpr ValueSet reads{Value::volume,     Value::temperature, Value::conductivity,
                                  Value::wall_slope, Value::wall_warmth, Value::wall_heat_flux};
  static constexpr Field writes = Field::wall_heat;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    const WallProfile<typename P::V> profile = wall_profile(p);
    add_heat_of_wall(p, c, profile, {p.template j<Value::wall_heat_flux>(), P::V::zero()}, sums);
  }
};

/// The same of walls some of which have a coefficient or radiate.
struct WallTransferConduction {
  static constexpr std::string_view name = "WallTransferConduction";
  static constexpr bool always_double = true, over_walls = true;
  static constexpr ValueSet reads = WallConduction::reads | ValueSet{Value::wall_transfer, Value::wall_glow};
  static constexpr Field writes = Field::wall_heat;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    const WallProfile<typename P::V> profile = wall_profile(p);
    add_heat_of_wall(p, c, profile, flux(p, profile), sums);
  }

 private:
  // The balance of the face is concave and falls with T_f. What comes in, q_0 + k T_i / d, is more than what either the
  // linear or the radiating part alone takes: from the lower of the two temperatures that this bounds T_f by, at most twice
  // the root, Newton's steps come down to it, to rounding, however much these parts differ.
  template <class P, class V>
  static FaceFlux<V> flux(const P& p, const WallProfile<V>& profile) {
    using T = typename P::Scalar;
    constexpr int steps = 5;
    const V near = sqrt(profile.steepness) +
                   where_equal(profile.steepness, V::zero(), V(T(1)) / max(p.r, V(static_cast<T>(1e-3))));
    const V conducts = p.template i<Value::conductivity>() * near, tiny(static_cast<T>(1e-30));
    const V own = p.template i<Value::temperature>(), given = p.template j<Value::wall_heat_flux>(),
            linear = p.template j<Value::wall_transfer>(), glow = p.template j<Value::wall_glow>();
    const auto out = [&](V t) { return linear * t + glow * (t * t * (t * t)); };
    const auto slope = [&](V t) { return linear + V(T(4)) * glow * (t * t * t); };
    const V in = given + conducts * own;
    V face = min(in / max(linear + conducts, tiny), sqrt(sqrt(max(in, V::zero()) / max(glow, tiny))));
    for (int k = 0; k < steps; ++k)
      face += (given - out(face) - conducts * (face - own)) / max(conducts + slope(face), tiny);
    const V takes = slope(face);
    return {given - out(face), takes * (conducts / max(conducts + takes, tiny))};
  }
};

}  // namespace sph
