// Gas that flows through the bubbles of magma by Darcy's law (Ida eq. 16), exchanged pair by pair: what a particle of
// fixed liquid mass gains its partner loses, to the bit. Per second
//   dm_ij = 2 V_i V_j F l (P_j - P_i - rho_g g.(x_j - x_i)),   F = -W'/r over its moment on the lattice,
//   l = 2 k_i k_j / (k_i + k_j) min((b_i + b_j) / 2, 2 b_up),   b = rho_g f(psi) / eta_g,
// k the scale of the group, "up" where the potential is higher. The harmonic mean of all of k b would freeze fronts
// (Barenblatt's peak comes out twice too high), the plain mean drain melt whose bubbles are not connected. The gas
// takes the mean velocity of the pair along: momentum is conserved, and so is the kinetic energy of what flows.
#pragma once

#include "sph/pairs/pair_values.hpp"
#include "sph/terms/head.hpp"
#include "sph/terms/wall_profile.hpp"

namespace sph {

template <class V>
struct GasExchange {
  V drive;  ///< towards the first of the pair where positive [Pa]
  V flow;   ///< to it [kg/s]
};

template <class P, class C>
[[nodiscard]] GasExchange<typename P::V> gas_exchange(const P& p, const C& c) {
  using V = typename P::V;
  using T = typename P::Scalar;
  const V half(T(0.5)), tiny(static_cast<T>(1e-300));
  const V k_i = p.template i<Value::permeability>(), k_j = p.template j<Value::permeability>();
  const V b_i = p.template i<Value::gas_mobility>(), b_j = p.template j<Value::gas_mobility>();
  const V rho = half * (p.template i<Value::gas_density>() + p.template j<Value::gas_density>());
  const V drive =
      (p.template j<Value::gas_pressure>() - p.template i<Value::gas_pressure>()) - rho * head(p, c);
  const V up = where_less(V::zero(), drive, b_j) + where_less(drive, V::zero(), b_i);
  const V twice_scale = V(4) * (k_i * k_j) / max(k_i + k_j, tiny);
  const V conductance = twice_scale * min(half * (b_i + b_j), up + up);
  return {drive, -(p.template i<Value::volume>() * p.template j<Value::volume>() * conductance *
                   (V(c.viscous.laplacian) * p.f)) *
                     drive};
}

inline constexpr ValueSet gas_exchange_reads{Value::volume, Value::permeability, Value::gas_mobility,
                                             Value::gas_pressure, Value::gas_density};

struct GasFlow {
  static constexpr std::string_view name = "GasFlow";
  static constexpr bool always_double = true;
  static constexpr ValueSet reads = gas_exchange_reads | ValueSet{Value::velocity};
  static constexpr Field writes = Field::gas_gain;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    using V = typename P::V;
    const V half(static_cast<typename P::Scalar>(0.5)), flow = gas_exchange(p, c).flow;
    sums.template add<Field::gas_gain>(0, flow);
    for (int a = 0; a < P::dim; ++a)
      sums.template add<Field::gas_gain>(
          1 + a, half * flow * (p.template j<Value::velocity>(a) - p.template i<Value::velocity>(a)));
  }
};

/// The heat that gas brings: c_p T of where it comes from. Latent heat stays with what is molten.
struct GasHeat {
  static constexpr std::string_view name = "GasHeat";
  static constexpr bool always_double = true;
  static constexpr ValueSet reads = gas_exchange_reads | ValueSet{Value::sensible_heat};
  static constexpr Field writes = Field::gas_heat;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    using V = typename P::V;
    const GasExchange<V> gas = gas_exchange(p, c);
    const V heat = where_less(V::zero(), gas.drive, p.template j<Value::sensible_heat>()) +
                   where_less(gas.drive, V::zero(), p.template i<Value::sensible_heat>());
    sums.template add<Field::gas_heat>(0, gas.flow * heat);
  }
};

/// From walls that let gas pass, along a straight profile between the particle and the face (wall_profile.hpp).
struct WallGas {
  static constexpr std::string_view name = "WallGas";
  static constexpr bool always_double = true, only_beside_walls = true;
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
    sums.template add<Field::wall_gas>(
        0, -(p.template i<Value::volume>() * p.template j<Value::volume>() * p.f * V(c.viscous.laplacian)) *
               ((own + own) * wall_profile(p).share() * p.template j<Value::wall_open>() * drive));
  }
};

}  // namespace sph
