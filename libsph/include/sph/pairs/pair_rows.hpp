// Pair rows: what a pass reads of a particle, packed into one short aligned record, so that a partner costs
// one or two cache lines. A pass's row holds the union of what its terms read, nothing else: a fluid-only
// scene has no stress in it. Everything is scaled to be of order one in float: lengths by the smoothing
// length h, volumes by spacing^D; a pass's sums are multiplied by the constant that undoes it, once.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "sph/core/particles.hpp"
#include "sph/core/simd.hpp"
#include "sph/pairs/pair_values.hpp"

namespace sph {

/// Offsets, in scalars, of the values in a row: position first, then in the order of the enum; the stride is
/// a multiple of four, the unit of the transposed load.
template <int D, ValueSet S>
struct RowLayout {
  [[nodiscard]] static constexpr int offset(Value v) {
    int at = D;
    for (int k = 0; k < static_cast<int>(v); ++k)
      if (S.has(static_cast<Value>(k))) at += components(static_cast<Value>(k), D);
    return at;
  }
  static constexpr int used = offset(Value::count_);
  static constexpr int stride = (used + 3) / 4 * 4;
};

/// Fills rows [first, last) of `rows`.
template <class T, int D, ValueSet S>
void pack_rows(const Particles& p, const GroupTable& groups, const RowScale& scale, std::size_t first,
               std::size_t last, T* rows) {
  using Layout = RowLayout<D, S>;
  const auto* x = p.data<Field::position>();
  const auto* v = p.data<Field::velocity>();
  const auto* mass = p.data<Field::mass>();
  const auto* rho = p.data<Field::density>();
  const auto* pressure = p.data<Field::pressure>();
  const auto* stress = p.data<Field::stress>();
  const auto* sound = p.data<Field::sound_speed>();
  const auto* group = p.data<Field::group>();
  const auto* walls = p.data<Field::wall_pressures>();
  const auto* colour = p.data<Field::colour_gradient>();
  const auto* curvature = p.data<Field::curvature>();
  const auto* displacement = p.data<Field::displacement>();
  const auto* bond_stress = p.data<Field::bond_stress>();
  const auto* direction = p.data<Field::direction>();
  const auto* wall_slope = p.data<Field::wall_slope>();
  const auto* energy = p.data<Field::specific_energy>();
  const auto* width = p.data<Field::smoothing_length>();
  const auto* correction = p.data<Field::kernel_correction>();
  const auto* gradient = p.data<Field::velocity_gradient>();
  const auto* liquid = p.data<Field::liquid_density>();
  const auto* grain_drag = p.data<Field::grain_drag>();
  const auto coordinate = [&](std::int64_t quanta) {
    if constexpr (sizeof(T) == 4)
      return std::bit_cast<float>(static_cast<std::uint32_t>(quanta >> scale.position_shift));
    else
      return std::bit_cast<double>(quanta);
  };
  for (std::size_t i = first; i < last; ++i) {
    T* row = rows + i * Layout::stride;
    for (int k = 0; k < D; ++k) row[k] = coordinate(x[i * D + k]);
    const auto put = [row](Value value, int k, double number) {
      row[Layout::offset(value) + k] = static_cast<T>(number);
    };
    if constexpr (S.has(Value::velocity))
      for (int k = 0; k < D; ++k) put(Value::velocity, k, v[i * D + k]);
    if constexpr (S.has(Value::volume)) put(Value::volume, 0, mass[i] / rho[i] * scale.inverse_volume);
    if constexpr (S.has(Value::pressure)) put(Value::pressure, 0, pressure[i]);
    if constexpr (S.has(Value::density)) put(Value::density, 0, rho[i]);
    if constexpr (S.has(Value::viscosity))
      put(Value::viscosity, 0, groups.viscosity[group[i]] * scale.inverse_h);
    if constexpr (S.has(Value::sound_speed))
      put(Value::sound_speed, 0, sound != nullptr ? sound[i] : groups.sound_speed[group[i]]);
    if constexpr (S.has(Value::phase)) put(Value::phase, 0, static_cast<double>(group[i]));
    if constexpr (S.has(Value::mover)) put(Value::mover, 0, groups.mover[group[i]]);
    if constexpr (S.has(Value::potential)) {
      double square = 0;
      for (int k = 0; k < D; ++k) {
        const double away = static_cast<double>(x[i * D + k]) * scale.quantum - scale.pull_centre[k];
        square += away * away;
      }
      put(Value::potential, 0, 0.5 * scale.pull * square);
    }
    if constexpr (S.has(Value::stress)) {
      constexpr int n = components(Value::stress, D);
      for (int k = 0; k < n; ++k) put(Value::stress, k, stress[i * n + k] - (k < D ? pressure[i] : 0.0));
    }
    if constexpr (S.has(Value::heavy)) put(Value::heavy, 0, groups.heavy[group[i]]);
    if constexpr (S.has(Value::pressures))
      for (int k = 0; k < 2; ++k)
        put(Value::pressures, k, groups.mover[group[i]] == 0 ? walls[2 * i + k] : pressure[i]);
    if constexpr (S.has(Value::side)) put(Value::side, 0, groups.side[group[i]]);
    if constexpr (S.has(Value::capillary)) {
      const double* g = colour + i * D;
      double square = 0;
      for (int a = 0; a < D; ++a) square += g[a] * g[a];
      const double length = std::sqrt(square), inverse = length > 0 ? 1 / length : 0.0;
      for (int a = 0; a < D; ++a)
        for (int b = a; b < D; ++b)
          put(Value::capillary, symmetric_index(a, b, D),
              groups.surface_tension * ((a == b ? length : 0.0) - g[a] * g[b] * inverse));
    }
    // Of particles on neither side nothing is known.
    if constexpr (S.has(Value::interface_weight)) {
      const double side = groups.side[group[i]];
      const double share = side != 0 ? layer_share(colour + i * D, D, scale.inverse_h) : 0.0;
      put(Value::interface_weight, 0, share > 0 ? mass[i] / rho[i] * scale.inverse_volume * share : 0.0);
      if constexpr (S.has(Value::interface_normal))
        for (int a = 0; a < D; ++a)
          put(Value::interface_normal, a,
              share > 0 ? side * colour[i * D + a] / (share * scale.inverse_h) : 0.0);
    }
    if constexpr (S.has(Value::curvature))
      put(Value::curvature, 0, groups.side[group[i]] != 0 ? curvature[i] : 0.0);
    if constexpr (S.has(Value::capillary_pressure))
      put(Value::capillary_pressure, 0,
          groups.side[group[i]] != 0 ? groups.surface_tension * curvature[i] : 0.0);
    // A difference: it passes through a periodic face with the position, which has the image's shift.
    if constexpr (S.has(Value::reference))
      for (int k = 0; k < D; ++k)
        row[Layout::offset(Value::reference) + k] = coordinate(x[i * D + k] - displacement[i * D + k]);
    if constexpr (S.has(Value::reference_cell))
      for (int k = 0; k < D; ++k)
        put(Value::reference_cell, k,
            static_cast<double>((x[i * D + k] - displacement[i * D + k]) >> (scale.position_shift + 29)));
    if constexpr (S.has(Value::reference_volume))
      put(Value::reference_volume, 0, mass[i] / groups.density[group[i]] * scale.inverse_volume);
    if constexpr (S.has(Value::body)) put(Value::body, 0, groups.body[group[i]]);
    if constexpr (S.has(Value::bond_stress))
      for (int k = 0; k < D * D; ++k) put(Value::bond_stress, k, bond_stress[i * D * D + k]);
    if constexpr (S.has(Value::modulus)) put(Value::modulus, 0, groups.modulus[group[i]]);
    if constexpr (S.has(Value::direction))
      for (int k = 0; k < D; ++k) put(Value::direction, k, direction[i * D + k]);
    if constexpr (S.has(Value::wall_slope))  // of partners it is not read
      for (int k = 0; k < D; ++k)
        put(Value::wall_slope, k, wall_slope != nullptr && i < p.owned() ? wall_slope[i * D + k] : 0.0);
    if constexpr (S.has(Value::specific_energy)) put(Value::specific_energy, 0, energy[i]);
    if constexpr (S.has(Value::width)) put(Value::width, 0, width[i] * scale.inverse_h);
    // Of walls neither is known, nor wanted.
    if constexpr (S.has(Value::kernel_correction))
      put(Value::kernel_correction, 0, groups.mover[group[i]] == 0 ? 1.0 : correction[i]);
    if constexpr (S.has(Value::velocity_gradient))
      for (int k = 0; k < D * D; ++k)
        put(Value::velocity_gradient, k,
            groups.mover[group[i]] == 0 ? 0.0 : gradient[i * D * D + k] / scale.inverse_h);
    if constexpr (S.has(Value::shears)) put(Value::shears, 0, groups.shears[group[i]]);
    if constexpr (S.has(Value::rest_gradient))  // of walls it is not known, nor wanted
      for (int k = 0; k < D; ++k)
        put(Value::rest_gradient, k,
            groups.mover[group[i]] == 0
                ? 0.0
                : liquid[i] * (scale.gravity[k] + grain_drag[i * D + k]) * scale.head[k]);
  }
}

}  // namespace sph
