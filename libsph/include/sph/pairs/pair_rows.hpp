// Pair rows: what a pass reads of a particle, packed into one short aligned record, so that a partner costs
// one or two cache lines. A pass's row holds the union of what its terms read, nothing else: a fluid-only
// scene has no stress in it. Everything is scaled to be of order one in float: lengths by the smoothing
// length h, volumes by spacing^D; a pass's sums are multiplied by the constant that undoes it, once.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "sph/core/fixed_point.hpp"
#include "sph/core/particles.hpp"
#include "sph/core/simd.hpp"
#include "sph/pairs/row_layout.hpp"

namespace sph {

/// The row of particle i while it is filled.
template <class T, int D, ValueSet S, bool HalfStepBack>
struct PackedRow {
  static constexpr int dim = D;
  static constexpr ValueSet values = S;
  static constexpr bool half_step_back = HalfStepBack;
  using Layout = RowLayout<D, S>;
  const GroupTable& groups;
  const RowScale& scale;
  T* numbers;
  std::size_t i;
  std::uint32_t group;

  [[nodiscard]] bool is_wall() const { return groups.mover[group] == 0; }
  [[gnu::always_inline]] void put(Value value, int k, double number) const {
    numbers[Layout::offset(value) + k] = static_cast<T>(number);
  }
  [[gnu::always_inline]] void put_position(int at, std::int64_t quanta) const {
    if constexpr (sizeof(T) == 4)
      numbers[at] = std::bit_cast<float>(static_cast<std::uint32_t>(quanta >> scale.position_shift));
    else
      numbers[at] = std::bit_cast<double>(quanta);
  }
};

/// What every fluid or solid has: motion, density, pressure, and constants of its group.
struct StateColumns {
  explicit StateColumns(const Particles& p)
      : x(p.data<Field::position>()),
        v(p.data<Field::velocity>()),
        mass(p.data<Field::mass>()),
        rho(p.data<Field::density>()),
        pressure(p.data<Field::pressure>()),
        stress(p.data<Field::stress>()),
        sound(p.data<Field::sound_speed>()),
        walls(p.data<Field::wall_pressures>()),
        energy(p.data<Field::specific_energy>()),
        viscosity(p.data<Field::viscosity>()) {}
  const std::int64_t* x;
  const double *v, *mass, *rho, *pressure, *stress, *sound, *walls, *energy, *viscosity;

  template <class Row>
  [[gnu::always_inline]] void pack(const Row& row) const {
    constexpr ValueSet S = Row::values;
    constexpr int D = Row::dim;
    const std::size_t i = row.i;
    const GroupTable& groups = row.groups;
    const RowScale& scale = row.scale;
    for (int k = 0; k < D; ++k)
      row.put_position(k, Row::half_step_back
                              ? moved_by(x[i * D + k], -round_to_quanta(v[i * D + k] * scale.half_step))
                              : x[i * D + k]);
    if constexpr (S.has(Value::velocity))
      for (int k = 0; k < D; ++k) row.put(Value::velocity, k, v[i * D + k]);
    if constexpr (S.has(Value::volume)) {
      const double volume = mass[i] / rho[i] * scale.inverse_volume;
      row.put(Value::volume, 0, Row::Layout::volume_tells_mover && row.is_wall() ? -volume : volume);
    }
    if constexpr (S.has(Value::pressure)) row.put(Value::pressure, 0, pressure[i]);
    if constexpr (S.has(Value::density)) row.put(Value::density, 0, rho[i]);
    if constexpr (S.has(Value::weight))
      row.put(Value::weight, 0, rho[i] * groups.weight.share[row.group] - groups.weight.borne[row.group]);
    if constexpr (S.has(Value::viscosity))
      row.put(Value::viscosity, 0,
              (viscosity != nullptr ? viscosity[i] : groups.viscosity[row.group]) * scale.inverse_h);
    if constexpr (S.has(Value::sound_speed))
      row.put(Value::sound_speed, 0, sound != nullptr ? sound[i] : groups.sound_speed[row.group]);
    if constexpr (S.has(Value::phase)) row.put(Value::phase, 0, static_cast<double>(row.group));
    if constexpr (S.has(Value::mover) && !Row::Layout::volume_tells_mover)
      row.put(Value::mover, 0, groups.mover[row.group]);
    if constexpr (S.has(Value::potential)) {
      double square = 0;
      for (int k = 0; k < D; ++k) {
        const double away = static_cast<double>(x[i * D + k]) * scale.quantum - scale.pull_centre[k];
        square += away * away;
      }
      row.put(Value::potential, 0, 0.5 * scale.pull * square);
    }
    if constexpr (S.has(Value::stress)) {
      constexpr int n = components(Value::stress, D);
      for (int k = 0; k < n; ++k) row.put(Value::stress, k, stress[i * n + k] - (k < D ? pressure[i] : 0.0));
    }
    if constexpr (S.has(Value::heavy)) row.put(Value::heavy, 0, groups.heavy[row.group]);
    if constexpr (S.has(Value::pressures))
      for (int k = 0; k < 2; ++k)
        row.put(Value::pressures, k, row.is_wall() ? walls[2 * i + k] : pressure[i]);
    if constexpr (S.has(Value::specific_energy)) row.put(Value::specific_energy, 0, energy[i]);
    if constexpr (S.has(Value::shears)) row.put(Value::shears, 0, groups.shears[row.group]);
  }
};

/// Of the interface with tension. Of particles on neither side nothing is known.
struct InterfaceColumns {
  explicit InterfaceColumns(const Particles& p)
      : mass(p.data<Field::mass>()),
        rho(p.data<Field::density>()),
        colour(p.data<Field::colour_gradient>()),
        curvature(p.data<Field::curvature>()) {}
  const double *mass, *rho, *colour, *curvature;

  template <class Row>
  [[gnu::always_inline]] void pack(const Row& row) const {
    constexpr ValueSet S = Row::values;
    constexpr int D = Row::dim;
    const std::size_t i = row.i;
    const double tension = row.groups.surface_tension, inverse_h = row.scale.inverse_h;
    [[maybe_unused]] const auto side = [&] { return row.groups.side[row.group]; };
    if constexpr (S.has(Value::side)) row.put(Value::side, 0, side());
    if constexpr (S.has(Value::capillary)) {
      const double* g = colour + i * D;
      double square = 0;
      for (int a = 0; a < D; ++a) square += g[a] * g[a];
      const double length = std::sqrt(square), inverse = length > 0 ? 1 / length : 0.0;
      for (int a = 0; a < D; ++a)
        for (int b = a; b < D; ++b)
          row.put(Value::capillary, symmetric_index(a, b, D),
                  tension * ((a == b ? length : 0.0) - g[a] * g[b] * inverse));
    }
    if constexpr (S.has(Value::interface_weight)) {
      const double on = side(), share = on != 0 ? layer_share(colour + i * D, D, inverse_h) : 0.0;
      row.put(Value::interface_weight, 0,
              share > 0 ? mass[i] / rho[i] * row.scale.inverse_volume * share : 0.0);
      if constexpr (S.has(Value::interface_normal))
        for (int a = 0; a < D; ++a)
          row.put(Value::interface_normal, a, share > 0 ? on * colour[i * D + a] / (share * inverse_h) : 0.0);
    }
    if constexpr (S.has(Value::curvature)) row.put(Value::curvature, 0, side() != 0 ? curvature[i] : 0.0);
    if constexpr (S.has(Value::capillary_pressure))
      row.put(Value::capillary_pressure, 0, side() != 0 ? tension * curvature[i] : 0.0);
  }
};

/// Of total-Lagrangian solids.
struct BondColumns {
  explicit BondColumns(const Particles& p)
      : x(p.data<Field::position>()),
        displacement(p.data<Field::displacement>()),
        mass(p.data<Field::mass>()),
        stress(p.data<Field::bond_stress>()),
        shift(p.data<Field::clamp_shift>()),
        reaction(p.data<Field::clamp_reaction>()) {}
  const std::int64_t *x, *displacement;
  const double *mass, *stress, *shift, *reaction;

  template <class Row>
  [[gnu::always_inline]] void pack(const Row& row) const {
    constexpr ValueSet S = Row::values;
    constexpr int D = Row::dim;
    const std::size_t i = row.i;
    const GroupTable& groups = row.groups;
    // A difference: it passes through a periodic face with the position, which has the image's shift.
    [[maybe_unused]] const auto reference = [&](int k) { return x[i * D + k] - displacement[i * D + k]; };
    if constexpr (S.has(Value::reference))
      for (int k = 0; k < D; ++k) row.put_position(Row::Layout::offset(Value::reference) + k, reference(k));
    if constexpr (S.has(Value::reference_cell))
      for (int k = 0; k < D; ++k)
        row.put(Value::reference_cell, k,
                static_cast<double>(reference(k) >> (row.scale.position_shift + 29)));
    if constexpr (S.has(Value::reference_volume))
      row.put(Value::reference_volume, 0,
              mass[i] / groups.weight.density[row.group] * row.scale.inverse_volume);
    if constexpr (S.has(Value::body)) row.put(Value::body, 0, groups.bodies.number[row.group]);
    if constexpr (S.has(Value::bond_stress))
      for (int k = 0; k < D * D; ++k) row.put(Value::bond_stress, k, stress[i * D * D + k]);
    if constexpr (S.has(Value::clamp_shift))
      for (int k = 0; k < D; ++k)
        row.put(Value::clamp_shift, k,
                shift != nullptr && row.is_wall() ? shift[i * D + k] * row.scale.inverse_h : 0.0);
    if constexpr (S.has(Value::clamp_reaction))
      for (int k = 0; k < D; ++k)
        row.put(Value::clamp_reaction, k, row.is_wall() ? reaction[i * D + k] : 0.0);
    if constexpr (S.has(Value::modulus)) row.put(Value::modulus, 0, groups.bodies.modulus[row.group]);
    if constexpr (S.has(Value::hourglass)) row.put(Value::hourglass, 0, groups.bodies.hourglass[row.group]);
  }
};

/// Of solids that crack.
struct CrackColumns {
  explicit CrackColumns(const Particles& p)
      : crack(p.data<Field::crack>()),
        distance(p.data<Field::crack_distance>()),
        closing(p.data<Field::crack_closing>()),
        overload(p.data<Field::overload>()),
        failing(p.data<Field::failing>()) {}
  const double *crack, *distance, *closing, *overload;
  const std::uint32_t* failing;

  template <class Row>
  [[gnu::always_inline]] void pack(const Row& row) const {
    constexpr ValueSet S = Row::values;
    constexpr int D = Row::dim;
    const std::size_t i = row.i;
    if constexpr (S.has(Value::crack)) {
      double square = 0;
      for (int k = 0; k < D; ++k) square += crack[i * D + k] * crack[i * D + k];
      const double length = std::sqrt(square);
      for (int k = 0; k < D; ++k) row.put(Value::crack, k, length > 0 ? crack[i * D + k] / length : 0.0);
    }
    if constexpr (S.has(Value::crack_distance)) row.put(Value::crack_distance, 0, distance[i]);
    if constexpr (S.has(Value::crack_closing)) row.put(Value::crack_closing, 0, closing[i]);
    if constexpr (S.has(Value::overload)) row.put(Value::overload, 0, overload[i]);
    if constexpr (S.has(Value::failing)) row.put(Value::failing, 0, failing[i]);
  }
};

/// Of total-Lagrangian solids in a fluid.
struct WetColumns {
  explicit WetColumns(const Particles& p)
      : pressure(p.data<Field::pressure>()),
        velocity(p.data<Field::velocity>()),
        wet_pressure(p.data<Field::wet_pressure>()),
        wet_velocity(p.data<Field::wet_velocity>()),
        acceleration(p.data<Field::acceleration>()),
        flux(p.data<Field::flux>()) {}
  const double *pressure, *velocity, *wet_pressure, *wet_velocity, *acceleration, *flux;

  template <class Row>
  [[gnu::always_inline]] void pack(const Row& row) const {
    constexpr ValueSet S = Row::values;
    constexpr int D = Row::dim;
    const std::size_t i = row.i;
    [[maybe_unused]] const auto bonded = [&] { return row.groups.bodies.bonded[row.group] != 0; };
    if constexpr (S.has(Value::wet_pressure))
      row.put(Value::wet_pressure, 0, bonded() ? wet_pressure[i] : pressure[i]);
    if constexpr (S.has(Value::wet_velocity))
      for (int k = 0; k < D; ++k)
        row.put(Value::wet_velocity, k, bonded() ? wet_velocity[i * D + k] : velocity[i * D + k]);
    if constexpr (S.has(Value::own_head))
      for (int k = 0; k < D; ++k)
        row.put(Value::own_head, k, bonded() ? -acceleration[i * D + k] / row.scale.inverse_h : 0.0);
    if constexpr (S.has(Value::flux)) row.put(Value::flux, 0, flux[i]);
  }
};

/// Of what is solved for.
struct ImplicitColumns {
  explicit ImplicitColumns(const Particles& p)
      : owned(p.owned()),
        direction(p.data<Field::direction>()),
        wall_slope(p.data<Field::wall_slope>()),
        trial(p.data<Field::trial>()) {}
  std::size_t owned;
  const double *direction, *wall_slope, *trial;

  template <class Row>
  [[gnu::always_inline]] void pack(const Row& row) const {
    constexpr int D = Row::dim;
    const std::size_t i = row.i;
    if constexpr (Row::values.has(Value::direction))
      for (int k = 0; k < D; ++k) row.put(Value::direction, k, direction[i * D + k]);
    if constexpr (Row::values.has(Value::wall_slope))  // of partners it is not read
      for (int k = 0; k < D; ++k)
        row.put(Value::wall_slope, k, wall_slope != nullptr && i < owned ? wall_slope[i * D + k] : 0.0);
    if constexpr (Row::values.has(Value::trial)) row.put(Value::trial, 0, trial[i]);
  }
};

/// Sums over neighbours that later sums correct themselves with. Of walls none is known, nor wanted.
struct CorrectionColumns {
  explicit CorrectionColumns(const Particles& p)
      : width(p.data<Field::smoothing_length>()),
        kernel(p.data<Field::kernel_correction>()),
        velocity(p.data<Field::velocity_gradient>()),
        liquid(p.data<Field::liquid_density>()),
        grain_drag(p.data<Field::grain_drag>()) {}
  const double *width, *kernel, *velocity, *liquid, *grain_drag;

  template <class Row>
  [[gnu::always_inline]] void pack(const Row& row) const {
    constexpr ValueSet S = Row::values;
    constexpr int D = Row::dim;
    const std::size_t i = row.i;
    const RowScale& scale = row.scale;
    if constexpr (S.has(Value::width)) row.put(Value::width, 0, width[i] * scale.inverse_h);
    if constexpr (S.has(Value::kernel_correction))
      row.put(Value::kernel_correction, 0, row.is_wall() ? 1.0 : kernel[i]);
    if constexpr (S.has(Value::velocity_gradient))
      for (int k = 0; k < D * D; ++k)
        row.put(Value::velocity_gradient, k, row.is_wall() ? 0.0 : velocity[i * D * D + k] / scale.inverse_h);
    if constexpr (S.has(Value::rest_gradient))
      for (int k = 0; k < D; ++k)
        row.put(Value::rest_gradient, k,
                row.is_wall() ? 0.0 : liquid[i] * (scale.gravity[k] + grain_drag[i * D + k]) * scale.head[k]);
  }
};

/// Of heat.
struct HeatColumns {
  explicit HeatColumns(const Particles& p) : temperature(p.data<Field::temperature>()) {}
  const double* temperature;

  template <class Row>
  [[gnu::always_inline]] void pack(const Row& row) const {
    constexpr ValueSet S = Row::values;
    const GroupTable& groups = row.groups;
    if constexpr (S.has(Value::temperature)) row.put(Value::temperature, 0, temperature[row.i]);
    if constexpr (S.has(Value::conductivity))
      row.put(Value::conductivity, 0, groups.heat.conductivity[row.group] * row.scale.inverse_h);
    if constexpr (S.has(Value::wall_warmth))
      row.put(Value::wall_warmth, 0, groups.heat.wall_warmth[row.group]);
    if constexpr (S.has(Value::wall_heat_flux))
      row.put(Value::wall_heat_flux, 0, groups.heat.wall_flux[row.group]);
    if constexpr (S.has(Value::wall_transfer)) {
      row.put(Value::wall_transfer, 0, groups.heat.wall_transfer[row.group]);
      row.put(Value::wall_glow, 0, groups.heat.wall_glow[row.group]);
    }
    if constexpr (S.has(Value::sensible_heat))
      row.put(Value::sensible_heat, 0, groups.heat.specific_heat[row.group] * temperature[row.i]);
    if constexpr (S.has(Value::grip)) row.put(Value::grip, 0, groups.heat.grip[row.group]);
  }
};

/// Of volatiles that flow through melt, or spread in it.
struct GasFlowColumns {
  explicit GasFlowColumns(const Particles& p)
      : mobility(p.data<Field::gas_mobility>()),
        pressure(p.data<Field::gas_pressure>()),
        content(p.data<Field::gas_content>()),
        dissolved(p.data<Field::dissolved_gas>()),
        rho(p.data<Field::density>()) {}
  const double *mobility, *pressure, *content, *dissolved, *rho;

  template <class Row>
  [[gnu::always_inline]] void pack(const Row& row) const {
    constexpr ValueSet S = Row::values;
    const GroupTable& groups = row.groups;
    if constexpr (S.has(Value::permeability))
      row.put(Value::permeability, 0, groups.gas_flow.permeability[row.group] * row.scale.inverse_h);
    if constexpr (S.has(Value::gas_mobility)) row.put(Value::gas_mobility, 0, mobility[row.i]);
    if constexpr (S.has(Value::gas_pressure)) row.put(Value::gas_pressure, 0, pressure[row.i]);
    if constexpr (S.has(Value::gas_density))
      row.put(Value::gas_density, 0,
              (pressure[row.i] + groups.gas_flow.surface_pressure) * groups.gas_flow.inverse_rt[row.group]);
    if constexpr (S.has(Value::wall_open)) row.put(Value::wall_open, 0, groups.gas_flow.wall_open[row.group]);
    if constexpr (S.has(Value::dissolved))
      row.put(Value::dissolved, 0, std::fmin(dissolved[row.i], content[row.i]));
    if constexpr (S.has(Value::water_mobility)) {
      const double d = groups.gas_flow.diffusivity[row.group] * row.scale.inverse_h;
      row.put(Value::water_mobility, 0, d > 0 ? rho[row.i] / (1 + content[row.i]) * d : 0.0);
    }
  }
};

/// Fills rows [first, last) of `rows`, with the places of half a step ago or those of now.
template <class T, int D, ValueSet S, bool HalfStepBack>
void pack_rows(const Particles& p, const GroupTable& groups, const RowScale& scale, std::size_t first,
               std::size_t last, T* rows) {
  const StateColumns state(p);
  const InterfaceColumns interface(p);
  const BondColumns bonds(p);
  const CrackColumns cracks(p);
  const WetColumns wet(p);
  const ImplicitColumns implicit(p);
  const CorrectionColumns corrections(p);
  const HeatColumns heat(p);
  const GasFlowColumns gas(p);
  const auto* group = p.data<Field::group>();
  for (std::size_t i = first; i < last; ++i) {
    const PackedRow<T, D, S, HalfStepBack> row{groups, scale, rows + i * RowLayout<D, S>::stride, i,
                                               group[i]};
    state.pack(row);
    interface.pack(row);
    bonds.pack(row);
    cracks.pack(row);
    wet.pack(row);
    implicit.pack(row);
    corrections.pack(row);
    heat.pack(row);
    gas.pack(row);
  }
}

}  // namespace sph
