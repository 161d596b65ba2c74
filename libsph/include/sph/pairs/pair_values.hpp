// Pair terms by name, what they can read of a particle, and what is constant for a scene in the units of pair rows.
#pragma once

#include <cmath>
#include <compare>
#include <cstdint>
#include <initializer_list>
#include <string_view>
#include <vector>

#include "sph/core/fields.hpp"

namespace sph {

/// A pair term, by the name of its struct (terms/).
struct Term {
  std::string_view name;
  friend auto operator<=>(const Term&, const Term&) = default;
};
template <class T>
inline constexpr Term term{T::name};

/// What the sum of a term in a pass of its own is (added_term.hpp): an acceleration [m/s^2], with the scale of
/// a sum of V_j grad W, or a velocity that particles drift with [m/s], with that of a sum of V_j W.
enum class Effect : std::uint8_t { acceleration, drift };

/// What a term can read of a particle besides its position.
enum class Value : std::uint8_t {
  velocity,            ///< [m/s]
  volume,              ///< mass / density [spacing^D]
  pressure,            ///< [Pa]
  density,             ///< [kg/m^3]
  viscosity,           ///< eta / h [Pa s/m]
  sound_speed,         ///< [m/s]
  phase,               ///< index of the group
  mover,               ///< 1, or 0 for walls
  stress,              ///< total: -pressure delta + stress field [Pa]
  heavy,               ///< 1 for the heavier fluids of the scene, 0 for all others
  pressures,           ///< for lighter and for heavier partners: of walls they differ [Pa]
  side,                ///< of the interface with tension: 1 or -1, 0 elsewhere
  capillary,           ///< surface stress sigma (I - n n) |grad C| [Pa]
  interface_normal,    ///< of the interface with tension, from the first fluid to the second; 0 far from it
  interface_weight,    ///< h |grad C| V [spacing^D]; 0 far from it
  curvature,           ///< of the interface with tension [1/m]
  capillary_pressure,  ///< sigma times it [Pa]
  potential,           ///< of the central pull [m^2/s^2]
  reference,           ///< reference position, stored as the position is
  reference_cell,      ///< the bits of it that a row in single precision has no room for
  reference_volume,    ///< mass / rho_0 [spacing^D]
  body,                ///< particles of one body have one number
  bond_stress,         ///< [Pa]
  modulus,             ///< K + 4/3 mu of the group, 0 of fluids [Pa]
  hourglass,           ///< stiffness of the group against hourglass modes, 0 of walls [Pa]
  clamp_shift,         ///< of clamps where bonds see them, less where they are, over h
  clamp_reaction,      ///< of clamps what they give back of the force on them [N]
  direction,           ///< what the viscous operator is applied to [m/s]
  wall_slope,          ///< gradient of a flow that is 0 at the wall and 1 here, times h
  specific_energy,     ///< of ideal gases, 0 of all else [J/kg]
  width,               ///< of ideal gases: smoothing length of the particle / h
  kernel_correction,   ///< 1 / Omega (terms/gas.hpp)
  velocity_gradient,   ///< h d v_a / d x_b [m/s]
  shears,              ///< 1 for solids and walls, 0 for fluids
  rest_gradient,       ///< of the pressure of a fluid with grains in it (terms/head.hpp), times h [Pa]
  temperature,         ///< [K]
  conductivity,        ///< k / h, 0 of walls [W/m^2/K]
  wall_warmth,         ///< 1 for walls that keep a temperature, else 0
  permeability,        ///< its scale / h, 0 of walls and of what is tight [m]
  gas_mobility,        ///< [s/m^2]
  gas_pressure,        ///< [Pa]
  gas_density,         ///< 0 of walls [kg/m^3]
  dissolved,           ///< w, of which there is no more than of all volatiles [1]
  water_mobility,  ///< density of the liquid without volatiles in all of the volume, times D / h [kg/m^2/s]
  wall_open,       ///< 1 for walls that let gas pass, else 0
  wall_heat_flux,  ///< of walls, into what is beside them, or would be were that at 0 K [W/m^2]
  wall_transfer,   ///< of walls: what of it a kelvin of the face takes [W/m^2/K] ...
  wall_glow,       ///< ... and its fourth power [W/m^2/K^4]
  sensible_heat,   ///< c_p T [J/kg]
  grip,            ///< 0 of walls that slip, else 1
  trial,           ///< what an implicit exchange is solved for [K or Pa]
  weight,          ///< density, less what a background bears of its weight [kg/m^3]
  wet_pressure,    ///< of a body what the fluid beside it presses with, else the pressure [Pa]
  wet_velocity,    ///< of a body the mirror image of the flow beside it, else the velocity [m/s]
  own_head,  ///< -a h of a body, a its acceleration: rho times it is grad p h beside it, less the weight's part
  crack,     ///< n over its length, 0 without a crack; of what has failed its plane's normal
  crack_distance,  ///< from that plane, over the width of bonds
  crack_closing,   ///< how much shorter across a crack than in the reference state when that came, over it
  overload,        ///< how far beyond its strength, over it
  failing,         ///< 1 where it has just become fluid, else 0
  flux,  ///< of solids and walls: what flows onto them, for the fluid beside them (terms/wetted.hpp)
  count_
};

class ValueSet {
 public:
  constexpr ValueSet() = default;
  constexpr ValueSet(std::initializer_list<Value> values) {
    for (Value v : values) bits_ |= std::uint64_t{1} << static_cast<int>(v);
  }
  [[nodiscard]] constexpr bool has(Value v) const { return ((bits_ >> static_cast<int>(v)) & 1u) != 0; }
  constexpr ValueSet operator|(ValueSet o) const {
    ValueSet r;
    r.bits_ = bits_ | o.bits_;
    return r;
  }

  std::uint64_t bits_ = 0;  ///< public only so that a set can be a template argument
};

[[nodiscard]] constexpr int components(Value v, int dim) {
  const bool vector = v == Value::velocity || v == Value::reference || v == Value::reference_cell ||
                      v == Value::direction || v == Value::wall_slope || v == Value::interface_normal ||
                      v == Value::rest_gradient || v == Value::wet_velocity || v == Value::clamp_shift ||
                      v == Value::clamp_reaction || v == Value::own_head || v == Value::crack;
  const bool tensor = v == Value::stress || v == Value::capillary;
  return vector                                                     ? dim
         : v == Value::pressures                                    ? 2
         : tensor                                                   ? dim * (dim + 1) / 2
         : v == Value::bond_stress || v == Value::velocity_gradient ? dim * dim
                                                                    : 1;
}

/// The fields a halo copy needs so that its row can be packed.
[[nodiscard]] constexpr FieldSet fields_behind(ValueSet values) {
  FieldSet f{Field::position};
  if (values.has(Value::velocity)) f |= FieldSet{Field::velocity};
  if (values.has(Value::volume)) f |= FieldSet{Field::mass, Field::density};
  if (values.has(Value::pressure)) f |= FieldSet{Field::pressure};
  if (values.has(Value::density)) f |= FieldSet{Field::density};
  if (values.has(Value::weight)) f |= FieldSet{Field::density, Field::group};
  if (values.has(Value::viscosity)) f |= FieldSet{Field::group, Field::viscosity};
  if (values.has(Value::sound_speed)) f |= FieldSet{Field::group, Field::sound_speed};
  if (values.has(Value::phase)) f |= FieldSet{Field::group};
  if (values.has(Value::mover)) f |= FieldSet{Field::group};
  if (values.has(Value::stress)) f |= FieldSet{Field::pressure, Field::stress};
  if (values.has(Value::heavy)) f |= FieldSet{Field::group};
  if (values.has(Value::pressures)) f |= FieldSet{Field::group, Field::pressure, Field::wall_pressures};
  if (values.has(Value::side)) f |= FieldSet{Field::group};
  if (values.has(Value::capillary)) f |= FieldSet{Field::colour_gradient};
  if (values.has(Value::interface_normal)) f |= FieldSet{Field::group, Field::colour_gradient};
  if (values.has(Value::interface_weight))
    f |= FieldSet{Field::group, Field::mass, Field::density, Field::colour_gradient};
  if (values.has(Value::curvature) || values.has(Value::capillary_pressure))
    f |= FieldSet{Field::group, Field::curvature};
  if (values.has(Value::reference) || values.has(Value::reference_cell)) f |= FieldSet{Field::displacement};
  if (values.has(Value::reference_volume)) f |= FieldSet{Field::mass, Field::group};
  if (values.has(Value::body) || values.has(Value::modulus) || values.has(Value::hourglass))
    f |= FieldSet{Field::group};
  if (values.has(Value::bond_stress)) f |= FieldSet{Field::bond_stress};
  if (values.has(Value::direction)) f |= FieldSet{Field::direction};
  if (values.has(Value::specific_energy)) f |= FieldSet{Field::specific_energy};
  if (values.has(Value::width)) f |= FieldSet{Field::smoothing_length};
  if (values.has(Value::kernel_correction)) f |= FieldSet{Field::kernel_correction};
  if (values.has(Value::clamp_shift)) f |= FieldSet{Field::clamp_shift};
  if (values.has(Value::clamp_reaction)) f |= FieldSet{Field::clamp_reaction};
  if (values.has(Value::wet_pressure)) f |= FieldSet{Field::group, Field::pressure, Field::wet_pressure};
  if (values.has(Value::wet_velocity)) f |= FieldSet{Field::group, Field::velocity, Field::wet_velocity};
  if (values.has(Value::own_head)) f |= FieldSet{Field::group, Field::acceleration};
  if (values.has(Value::crack)) f |= FieldSet{Field::crack};
  if (values.has(Value::crack_distance)) f |= FieldSet{Field::crack_distance};
  if (values.has(Value::crack_closing)) f |= FieldSet{Field::crack_closing};
  if (values.has(Value::overload)) f |= FieldSet{Field::overload};
  if (values.has(Value::failing)) f |= FieldSet{Field::failing};
  if (values.has(Value::flux)) f |= FieldSet{Field::flux};
  if (values.has(Value::velocity_gradient)) f |= FieldSet{Field::velocity_gradient};
  if (values.has(Value::shears)) f |= FieldSet{Field::group};
  if (values.has(Value::temperature)) f |= FieldSet{Field::temperature};
  if (values.has(Value::sensible_heat)) f |= FieldSet{Field::group, Field::temperature};
  if (values.has(Value::conductivity) || values.has(Value::wall_warmth) ||
      values.has(Value::wall_heat_flux) || values.has(Value::wall_transfer) || values.has(Value::grip))
    f |= FieldSet{Field::group};
  if (values.has(Value::permeability) || values.has(Value::wall_open)) f |= FieldSet{Field::group};
  if (values.has(Value::gas_mobility)) f |= FieldSet{Field::gas_mobility};
  if (values.has(Value::gas_pressure)) f |= FieldSet{Field::gas_pressure};
  if (values.has(Value::gas_density)) f |= FieldSet{Field::group, Field::gas_pressure};
  if (values.has(Value::dissolved)) f |= FieldSet{Field::dissolved_gas, Field::gas_content};
  if (values.has(Value::water_mobility)) f |= FieldSet{Field::group, Field::density, Field::gas_content};
  if (values.has(Value::trial)) f |= FieldSet{Field::trial};
  if (values.has(Value::rest_gradient)) f |= FieldSet{Field::liquid_density, Field::grain_drag};
  return f;
}

/// What is constant for all particles of a group, by group index.
struct GroupTable {
  std::vector<double> viscosity;    ///< [Pa s]
  std::vector<double> sound_speed;  ///< [m/s]
  std::vector<double> mover;        ///< 1 or 0
  std::vector<double> heavy;        ///< 1 or 0
  std::vector<double> side;         ///< 1, -1 or 0
  std::vector<double> shears;       ///< 1 or 0
  double surface_tension = 0;       ///< [N/m]
  struct Bodies {
    std::vector<double> number;     ///< index of the group, of a clamp that of the solid it holds
    std::vector<double> modulus;    ///< K + 4/3 mu, 0 of fluids [Pa]
    std::vector<double> hourglass;  ///< stiffness, 0 but of total-Lagrangian solids [Pa]
    std::vector<double> bonded;     ///< 1 for total-Lagrangian solids, else 0
  };
  Bodies bodies;
  /// Gravity acts on rho share - borne: rho (1 - rho_b / rho_0), of bubbly groups rho - rho_b.
  struct Weight {
    std::vector<double> density;       ///< rho_0 [kg/m^3]
    std::vector<double> share, borne;  ///< [1], [kg/m^3]
  };
  Weight weight;
  struct GasFlow {
    std::vector<double> permeability;  ///< scale [m^2]
    std::vector<double> inverse_rt;    ///< [s^2/m^2]
    std::vector<double> wall_open;     ///< 1 or 0
    std::vector<double> diffusivity;   ///< of what is dissolved [m^2/s]
    double surface_pressure = 0;       ///< [Pa]
  };
  struct Heat {
    std::vector<double> conductivity, specific_heat, wall_warmth, wall_flux, wall_transfer, wall_glow,
        grip;  ///< as the values have them
  };
  GasFlow gas_flow;
  Heat heat;
};

/// Scales of the rows; see the head of this file.
struct RowScale {
  int position_shift;     ///< float rows hold the low 32 bits of quanta >> shift, double rows the quanta
  double position_unit;   ///< length of one unit of a row's position / h
  double inverse_volume;  ///< 1 / spacing^D
  double inverse_h;       ///< 1 / h
  double quantum = 0;     ///< of the positions [m]
  double half_step = 0;   ///< dt / 2 over it [s/m]
  double pull = 0;        ///< Domain::central_pull [1/s^2]
  double pull_centre[3]{};
  double gravity[3]{};  ///< [m/s^2]
  double head[3]{};     ///< h, 0 along periods [m]
};

/// h |grad C| in the layer about the interface, as far as it is not noise; 0 farther off.
[[nodiscard]] inline double layer_share(const double* colour, int dim, double inverse_h) {
  constexpr double least = 0.02;
  double square = 0;
  for (int a = 0; a < dim; ++a) square += colour[a] * colour[a];
  const double share = std::sqrt(square) / inverse_h;
  return share > least ? share : 0.0;
}

}  // namespace sph
