// Gas that flows through the bubbles of magma by Darcy's law (Ida eq. 16), exchanged pair by pair: what a particle of
// fixed liquid mass gains its partner loses, to the bit. Per second
//   dm_ij = 2 V_i V_j F l (P_j - P_i - rho_g g.(x_j - x_i)),   F = -W'/r over its moment on the lattice,
//   l = 2 k_i k_j / (k_i + k_j) min((b_i + b_j) / 2, 2 b_up),   b = rho_g f(psi) / eta_g,
// k the scale of the group, "up" where the potential is higher. The harmonic mean of all of k b would freeze fronts
// (Barenblatt's peak comes out twice too high), the plain mean drain melt whose bubbles are not connected. The gas
// takes the mean velocity of the pair along: momentum is conserved, and so is the kinetic energy of what flows.
#pragma once

#include "sph/terms/exchange_rule.hpp"
#include "sph/terms/head.hpp"
#include "sph/terms/wall_profile.hpp"

namespace sph {

/// Towards the first of the pair where positive, if `pressure` drove the gas [Pa].
template <Value pressure, class P, class C>
[[nodiscard, gnu::always_inline]] inline typename P::V gas_drive(const P& p, const C& c) {
  using V = typename P::V;
  const V rho = V(static_cast<typename P::Scalar>(0.5)) *
                (p.template i<Value::gas_density>() + p.template j<Value::gas_density>());
  return (p.template j<pressure>() - p.template i<pressure>()) - rho * head(p, c);
}

/// b of the one where the potential by `pressure` is higher.
template <Value pressure, class P, class C>
[[nodiscard, gnu::always_inline]] inline typename P::V upstream_mobility(const P& p, const C& c) {
  using V = typename P::V;
  const V drive = gas_drive<pressure>(p, c);
  return where_less(V::zero(), drive, p.template j<Value::gas_mobility>()) +
         where_less(drive, V::zero(), p.template i<Value::gas_mobility>());
}

/// Of a pair, by the pressures at the start of the step [kg/s/Pa]; where an implicit step turns the flow round, limited by
/// what is upstream then too, or a particle would give gas that it does not have.
template <Value by, class P, class C>
[[nodiscard, gnu::always_inline]] inline typename P::V gas_conductance(const P& p, const C& c) {
  using V = typename P::V;
  using T = typename P::Scalar;
  const V b_i = p.template i<Value::gas_mobility>(), b_j = p.template j<Value::gas_mobility>();
  V up = upstream_mobility<Value::gas_pressure>(p, c);
  if constexpr (by != Value::gas_pressure) up = min(up, upstream_mobility<by>(p, c));
  return exchange_rate(p, c, exchange_mean<Value::permeability>(p) * min(V(T(0.5)) * (b_i + b_j), up + up));
}

inline constexpr ValueSet gas_exchange_reads{Value::volume, Value::permeability, Value::gas_mobility,
                                             Value::gas_pressure, Value::gas_density};

/// Driven by the pressures at the start of the step, or by those that the implicit step has found for its end.
template <Value by>
struct GasFlowBy {
  static constexpr std::string_view name = by == Value::trial ? "ImplicitGasFlow" : "GasFlow";
  static constexpr bool always_double = true;
  static constexpr ValueSet reads = gas_exchange_reads | ValueSet{Value::velocity, by};
  static constexpr Field writes = Field::gas_gain;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    add_matter(p, gas_conductance<by>(p, c) * gas_drive<by>(p, c), sums);
  }
};

/// The heat that gas brings: c_p T of where it comes from. Latent heat stays with what is molten.
template <Value by>
struct GasHeatBy {
  static constexpr std::string_view name = by == Value::trial ? "ImplicitGasHeat" : "GasHeat";
  static constexpr bool always_double = true;
  static constexpr ValueSet reads = gas_exchange_reads | ValueSet{Value::sensible_heat, by};
  static constexpr Field writes = Field::gas_heat;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    const auto drive = gas_drive<by>(p, c);
    sums.template add<Field::gas_heat>(0, gas_conductance<by>(p, c) * drive * heat_upstream(p, drive));
  }
};

using GasFlow = GasFlowBy<Value::gas_pressure>;
using GasHeat = GasHeatBy<Value::gas_pressure>;
using ImplicitGasFlow = GasFlowBy<Value::trial>;
using ImplicitGasHeat = GasHeatBy<Value::trial>;

/// Of any change of the pressures, for the implicit step (models/gas_flow_solver.hpp).
struct GasOperator {
  static constexpr std::string_view name = "GasOperator";
  static constexpr bool always_double = true;
  static constexpr ValueSet reads = gas_exchange_reads | ValueSet{Value::trial};
  static constexpr Field writes = Field::exchange_sums;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    const typename P::V rate = gas_conductance<Value::gas_pressure>(p, c);
    sums.template add<Field::exchange_sums>(
        0, rate * (p.template j<Value::trial>() - p.template i<Value::trial>()));
    sums.template add<Field::exchange_sums>(1, rate);
  }
};

/// For the gradient that drives the gas at a particle, Forchheimer's: D times the first sums over the last one and h. Walls
/// that let gas pass count, others have no pressure.
struct GasSlope {
  static constexpr std::string_view name = "GasSlope";
  static constexpr bool always_double = true;
  static constexpr ValueSet reads{Value::volume, Value::gas_pressure, Value::gas_density, Value::wall_open,
                                  Value::mover};
  static constexpr Field writes = Field::gas_slope;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    using V = typename P::V;
    const V weight = p.template j<Value::volume>() *
                     (p.template j<Value::mover>() + p.template j<Value::wall_open>()) * p.f;
    const V drive = (p.template j<Value::gas_pressure>() - p.template i<Value::gas_pressure>()) -
                    p.template i<Value::gas_density>() * head(p, c);
    for (int a = 0; a < P::dim; ++a) sums.template add<Field::gas_slope>(a, weight * drive * p.e[a]);
    sums.template add<Field::gas_slope>(P::dim, weight * p.r2);
  }
};

/// From walls that let gas pass, along a straight profile between the particle and the face (wall_profile.hpp).
struct WallGas {
  static constexpr std::string_view name = "WallGas";
  static constexpr bool always_double = true, over_walls = true;
  static constexpr ValueSet reads{Value::volume,       Value::permeability, Value::gas_mobility,
                                  Value::gas_pressure, Value::gas_density,  Value::wall_slope,
                                  Value::wall_open};
  static constexpr Field writes = Field::wall_gas;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    using V = typename P::V;
    const V own = p.template i<Value::permeability>() * p.template i<Value::gas_mobility>();
    const V drive = (p.template j<Value::gas_pressure>() - p.template i<Value::gas_pressure>()) -
                    p.template i<Value::gas_density>() * head(p, c);
    const V weight =
        -(p.template i<Value::volume>() * p.template j<Value::volume>() * p.f * V(c.viscous.laplacian));
    const V open = (own + own) * wall_profile(p).share() * p.template j<Value::wall_open>();
    sums.template add<Field::wall_gas>(0, weight * (open * drive));
    sums.template add<Field::wall_gas>(1, weight * open);
  }
};

}  // namespace sph
