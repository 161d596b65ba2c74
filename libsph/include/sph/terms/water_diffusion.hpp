// Water that is dissolved in magma and spreads, exchanged pair by pair: what a particle of fixed liquid mass gains its
// partner loses, to the bit. Per second
//   dm_ij = 2 V_i V_j F [2 a_i a_j / (a_i + a_j)] (w_j - w_i),   F = -W'/r over its moment on the lattice,
//   a = rho D / (1 + m): the density of the liquid in all of the volume, bubbles included, times its diffusivity,
// Fick's law in what is liquid. The harmonic mean keeps the flux where a jumps, as for heat (conduction.hpp), and is 0
// where one of both has no D. The water takes the mean velocity of the pair along, as gas does (gas_flow.hpp), and heat
// from where it comes.
#pragma once

#include "sph/terms/exchange_rule.hpp"

namespace sph {

/// Towards the first of the pair [kg/s].
template <class P, class C>
[[nodiscard, gnu::always_inline]] inline typename P::V water_flow(const P& p, const C& c) {
  return exchange_rate(p, c, exchange_mean<Value::water_mobility>(p)) *
         (p.template j<Value::dissolved>() - p.template i<Value::dissolved>());
}

inline constexpr ValueSet water_exchange_reads{Value::volume, Value::water_mobility, Value::dissolved};

struct WaterDiffusion {
  static constexpr std::string_view name = "WaterDiffusion";
  static constexpr bool always_double = true;
  static constexpr ValueSet reads = water_exchange_reads | ValueSet{Value::velocity};
  static constexpr Field writes = Field::gas_gain;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    add_matter(p, water_flow(p, c), sums);
  }
};

/// c_p T of where it comes from.
struct WaterHeat {
  static constexpr std::string_view name = "WaterHeat";
  static constexpr bool always_double = true;
  static constexpr ValueSet reads = water_exchange_reads | ValueSet{Value::sensible_heat};
  static constexpr Field writes = Field::gas_heat;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    const auto flow = water_flow(p, c);
    sums.template add<Field::gas_heat>(0, flow * heat_upstream(p, flow));
  }
};

}  // namespace sph
