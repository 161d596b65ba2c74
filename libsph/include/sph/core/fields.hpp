// The field table: every per-particle quantity is declared once, here. Storage, migration, halo messages,
// checkpoint, snapshot, fingerprint and `peperite check`'s byte counts are derived from it. A scene allocates
// only the fields its physics reads (FieldSet).
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "sph/core/field_names.hpp"

namespace sph {

/// 1, 2, 4, D, D(D+1)/2, D*D, 1+D, 2+D, 2+2D, 1+2D, 2+D(D+1)/2+D*D, D+D(D+1)/2, 2+2D+D(D+1)/2 components
enum class Shape : std::uint8_t {
  scalar,
  two,
  four,
  vector,
  symmetric,
  matrix,
  spread,
  shifting,
  wall,
  clamp,
  deformation,
  planes,
  cracks
};
enum class Type : std::uint8_t { f64, i64, u64, u32 };
/// What a pass multiplies a sum of its pairs by, once, to undo the scaled units of pair_rows.hpp: nothing,
/// the factor of sums of V_j grad W, of V_i V_j grad W, or of the density diffusion. none: no term sums it.
enum class SumScale : std::uint8_t { none, one, gradient, force, diffusion };

/// state: its bits at the start of a step determine the next step, so it is checkpointed and fingerprinted.
/// derived: computed from state in each step, before it is read; unless it is in `passing_sums` it goes with its row where
/// lists are made in between. `snapshot`: written to snapshots when the scene allocates it.
struct FieldInfo {
  Field field;
  std::string_view name;
  std::string_view unit;
  Type type;
  Shape shape;
  bool state;
  bool snapshot;
  std::string_view meaning;
  SumScale sum = SumScale::none;
};

// Symmetric tensors are stored xx, yy, xy in 2D and xx, yy, zz, xy, xz, yz in 3D; matrices row by row,
// velocity_gradient[i*D+j] = d v_i / d x_j. In snapshots tensors are xx, yy, zz, xy, yz, xz.
inline constexpr std::array<FieldInfo, field_count> field_table{{
    {Field::id, "id", "1", Type::u64, Shape::scalar, true, true, "global id, never depends on ranks"},
    {Field::position, "position", "quantum", Type::i64, Shape::vector, true, true,
     "fixed-point coordinates; metres = quanta * quantum"},
    {Field::velocity, "velocity", "m/s", Type::f64, Shape::vector, true, true,
     "velocity; of a cell of melt on its lower faces, each the component across it"},
    {Field::density, "density", "kg/m^3", Type::f64, Shape::scalar, true, true,
     "density; of a fluid with grains in it its mass over the volume of both"},
    {Field::mass, "mass", "kg", Type::f64, Shape::scalar, true, true, "mass (per metre of depth in 2D)"},
    {Field::group, "group", "1", Type::u32, Shape::scalar, true, true, "index into the scene's groups"},
    {Field::gas_content, "gas_content", "1", Type::f64, Shape::scalar, true, true,
     "m: mass of volatiles per mass of liquid melt, Ida eq. (14)"},
    {Field::specific_energy, "specific_energy", "J/kg", Type::f64, Shape::scalar, true, true,
     "u: internal energy of an ideal gas per mass"},
    {Field::smoothing_length, "smoothing_length", "m", Type::f64, Shape::scalar, true, true,
     "h of a particle of an ideal gas: it follows the particle's volume"},
    {Field::stress, "stress", "Pa", Type::f64, Shape::symmetric, true, true,
     "conservative: deviator of elastic particles; ida: full Cauchy stress, Ida eqs. (9), (11)"},
    {Field::radius, "radius", "m", Type::f64, Shape::scalar, true, true, "radius of a grain"},
    {Field::spin, "spin", "rad/s", Type::f64, Shape::vector, true, true, "angular velocity of a grain"},
    {Field::pressure, "pressure", "Pa", Type::f64, Shape::scalar, false, true,
     "pressure above the surface pressure; on walls extrapolated from the fluid"},
    {Field::volume, "volume", "m^3", Type::f64, Shape::scalar, false, false, "mass / density"},
    {Field::sound_speed, "sound_speed", "m/s", Type::f64, Shape::scalar, false, false,
     "local speed of sound where it varies (bubbly magma, ideal gas)"},
    {Field::void_fraction, "void_fraction", "1", Type::f64, Shape::scalar, false, true,
     "psi: volume fraction of gas, Ida eq. (14)"},
    {Field::force, "force", "N", Type::f64, Shape::vector, false, false, "sum of the pair forces",
     SumScale::force},
    {Field::heating, "heating", "W", Type::f64, Shape::spread, false, false,
     "of an ideal gas: heat of viscous forces and what is conducted; the viscous force [N]", SumScale::force},
    {Field::number_density, "number_density", "1", Type::f64, Shape::two, false, false,
     "kernel sums near a particle of an ideal gas: over movers, and over the volumes of walls",
     SumScale::one},
    {Field::gas_moments, "gas_moments", "1", Type::f64, Shape::deformation, false, false,
     "near a particle of an ideal gas: the sums of number_density with q dW/dq, then of W x x and W v x",
     SumScale::one},
    {Field::kernel_correction, "kernel_correction", "1", Type::f64, Shape::scalar, false, false,
     "1 / Omega of an ideal gas: what a kernel that follows the volume adds to the pressure force"},
    {Field::divergence, "divergence", "1/s", Type::f64, Shape::scalar, false, false, "div v",
     SumScale::gradient},
    {Field::diffusion, "diffusion", "kg/m^3/s", Type::f64, Shape::scalar, false, false,
     "density diffusion: its part of d rho/dt", SumScale::diffusion},
    {Field::velocity_gradient, "velocity_gradient", "1/s", Type::f64, Shape::matrix, false, false,
     "d v_i/d x_j", SumScale::gradient},
    {Field::spread, "spread", "1/m", Type::f64, Shape::shifting, false, false,
     "gradient of the particle concentration, against which particles are shifted, it itself over h, and so "
     "is the sum of squares of how fast movers part [m/s^2]",
     SumScale::gradient},
    {Field::colour_gradient, "colour_gradient", "1/m", Type::f64, Shape::vector, false, false,
     "near an interface with tension: gradient of the other fluid's share of the volume", SumScale::gradient},
    {Field::wall_sums, "wall_sums", "1", Type::f64, Shape::wall, false, false,
     "kernel sums over the fluid near a wall particle: weight, pressure, velocity, distance / h",
     SumScale::one},
    {Field::wall_sums_by_density, "wall_sums_by_density", "1", Type::f64, Shape::four, false, false,
     "the first two of wall_sums over lighter fluids, then over heavier ones", SumScale::one},
    {Field::wall_pressures, "wall_pressures", "Pa", Type::f64, Shape::two, false, false,
     "of a wall particle for lighter and for heavier fluids"},
    {Field::wall_mirror, "wall_mirror", "1", Type::f64, Shape::scalar, true, false,
     "of a wall particle: how much of the fluid's velocity it mirrors (wall_mirror.hpp), 1 if dry at the "
     "start"},
    {Field::velocity_mean, "velocity_mean", "m/s", Type::f64, Shape::vector, true, true,
     "running average over output.average_time"},
    {Field::pressure_mean, "pressure_mean", "Pa", Type::f64, Shape::scalar, true, true,
     "running average over output.average_time"},
    {Field::displacement, "displacement", "quantum", Type::i64, Shape::vector, true, true,
     "of total-Lagrangian solids: position less reference position"},
    {Field::bonds, "bonds", "1", Type::u32, Shape::scalar, true, false,
     "of total-Lagrangian solids: neighbours of the same body in the reference state"},
    {Field::deformation, "deformation", "1", Type::f64, Shape::deformation, false, false,
     "sums over bonds: their number, squared displacements, X X and u X (terms/bonds.hpp)", SumScale::one},
    {Field::bond_stress, "bond_stress", "Pa", Type::f64, Shape::matrix, false, false,
     "P L less the hourglass stress: what a particle brings into its bonds"},
    {Field::strain_energy, "strain_energy", "J", Type::f64, Shape::scalar, false, true,
     "of total-Lagrangian solids: elastic energy of the particle, hourglass energy included"},
    {Field::contact_energy, "contact_energy", "J", Type::f64, Shape::scalar, false, false,
     "half the energy of the particle's contacts with other bodies, and across cracks", SumScale::one},
    {Field::direction, "direction", "m/s", Type::f64, Shape::vector, false, false,
     "implicit viscosity: what the viscous operator is applied to"},
    {Field::viscous_sums, "viscous_sums", "N", Type::f64, Shape::spread, false, false,
     "viscous force on a particle if `direction` were the velocities, and the drag on it alone [kg/s]",
     SumScale::force},
    {Field::wall_share, "wall_share", "1/m", Type::f64, Shape::spread, false, false,
     "gradient of the walls' share of the kernel's volume, and it itself over h", SumScale::gradient},
    {Field::wall_slope, "wall_slope", "1", Type::f64, Shape::vector, false, false,
     "normal of the wall nearby times h over the distance from it"},
    {Field::curvature_sums, "curvature_sums", "1", Type::f64, Shape::two, false, false,
     "near an interface with tension: how its normals turn and over how far, or curvatures and their weight",
     SumScale::one},
    {Field::curvature, "curvature", "1/m", Type::f64, Shape::scalar, false, false,
     "of the interface with tension nearby, positive where its first fluid is inside; 0 far from it"},
    {Field::added, "added", "1/m", Type::f64, Shape::vector, false, false,
     "sum of a term of added_term.hpp, in the unit of the term", SumScale::gradient},
    {Field::porosity, "porosity", "1", Type::f64, Shape::scalar, true, true,
     "of a fluid with grains in it: its share of the volume; `density` is that of the fluid in all of the "
     "volume"},
    {Field::liquid_density, "liquid_density", "kg/m^3", Type::f64, Shape::scalar, false, true,
     "of a fluid with grains in it: density over porosity"},
    {Field::grain_pull, "grain_pull", "m/s^2", Type::f64, Shape::vector, true, false,
     "of a fluid with grains in it: what they accelerated it by in the step before"},
    {Field::grain_drag, "grain_drag", "m/s^2", Type::f64, Shape::vector, true, false,
     "of a fluid with grains in it: drag's part of that"},
    {Field::fluid_force, "fluid_force", "N", Type::f64, Shape::vector, false, true,
     "of the fluid on a grain in it: its stress over the grain's volume, and drag"},
    {Field::fluid_drag, "fluid_drag", "N", Type::f64, Shape::vector, false, false,
     "of the fluid on a grain in it: drag alone"},
    {Field::fluid_share, "fluid_share", "1", Type::f64, Shape::scalar, false, false,
     "of a grain: 1 over the sum of the kernel over the volumes of the fluid around it, 0 if there is none"},
    {Field::temperature, "temperature", "K", Type::f64, Shape::scalar, true, true,
     "of a cell of melt; of a fluid or solid with heat it follows from the enthalpy"},
    {Field::composition, "composition", "1", Type::f64, Shape::scalar, true, true,
     "of a cell: share of the second melt"},
    {Field::melt_share, "melt_share", "1", Type::f64, Shape::scalar, true, false,
     "volume of melt that flowed into a cell, over the cell's: 1 but for what the flow's tolerance leaves"},
    {Field::flow_pressure, "flow_pressure", "Pa", Type::f64, Shape::scalar, true, true,
     "of slow flow, less what holds layers at rest"},
    {Field::free_velocity, "free_velocity", "m/s", Type::f64, Shape::vector, true, false,
     "of a grain in melts that nothing touches"},
    {Field::free_spin, "free_spin", "rad/s", Type::f64, Shape::vector, true, false, "the same of its spin"},
    {Field::mobility, "mobility", "s/kg", Type::f64, Shape::two, true, false,
     "of a grain in melts: velocity per force, spin per torque [s/kg/m^2]"},
    {Field::contact_force, "contact_force", "N", Type::f64, Shape::vector, true, true,
     "on a grain in melts, of what it touched in the last step"},
    {Field::way, "way", "quantum", Type::i64, Shape::vector, true, false,
     "of a grain since the flow around it was found"},
    {Field::enthalpy, "enthalpy", "J/kg", Type::f64, Shape::scalar, true, true,
     "of fluids and solids with heat, above that at 0 K"},
    {Field::heat_gain, "heat_gain", "W", Type::f64, Shape::scalar, false, false,
     "heat that is conducted to a particle from others", SumScale::force},
    {Field::wall_heat, "wall_heat", "W", Type::f64, Shape::two, false, false,
     "... and from walls; how much less if the particle were 1 K warmer [W/K]", SumScale::force},
    {Field::heat_inflow, "heat_inflow", "J", Type::f64, Shape::scalar, true, false,
     "heat that a particle has had from walls, of friction and with gas from outside since the start"},
    {Field::mass_inflow, "mass_inflow", "kg", Type::f64, Shape::scalar, true, false,
     "mass without gas that a particle has had from resets of the pressure since the start, less what "
     "failure took"},
    {Field::liquid_mass, "liquid_mass", "kg", Type::f64, Shape::scalar, true, false,
     "of bubbly magma whose volatiles flow or spread: mass without them, which stays"},
    {Field::gas_mobility, "gas_mobility", "s/m^2", Type::f64, Shape::scalar, false, false,
     "density of the gas times the permeability's dependence on its share, over its viscosity"},
    {Field::gas_pressure, "gas_pressure", "Pa", Type::f64, Shape::scalar, false, false,
     "that drives the gas, above the surface pressure; of a wall that beyond it"},
    {Field::gas_gain, "gas_gain", "kg/s", Type::f64, Shape::spread, false, false,
     "gas, or dissolved, that comes to a particle from others, and the momentum that it brings [N]",
     SumScale::force},
    {Field::wall_gas, "wall_gas", "kg/s", Type::f64, Shape::two, false, false,
     "gas from walls; how much less if the particle's pressure were 1 Pa higher [kg/s/Pa]", SumScale::force},
    {Field::gas_inflow, "gas_inflow", "kg", Type::f64, Shape::scalar, true, false,
     "gas that a particle has had from walls since the start, less what escaped"},
    {Field::viscosity, "viscosity", "Pa s", Type::f64, Shape::scalar, false, true,
     "of fluids that have a law of it; on walls that of the fluid beside them"},
    {Field::wall_viscosity, "wall_viscosity", "1", Type::f64, Shape::two, false, false,
     "kernel sums over the fluid near a wall particle: volumes, and viscosities / h times them",
     SumScale::one},
    {Field::viscous_heat, "viscous_heat", "W", Type::f64, Shape::scalar, false, false,
     "heat of viscous friction", SumScale::force},
    {Field::gas_heat, "gas_heat", "W", Type::f64, Shape::scalar, false, false,
     "heat that gas, or what is dissolved, brings to a particle from others", SumScale::force},
    {Field::waiting_for, "waiting_for", "1", Type::u32, Shape::scalar, true, false,
     "row of its group's table of transitions that holds, from 1; 0: none"},
    {Field::waiting_time, "waiting_time", "s", Type::f64, Shape::scalar, true, false, "for how long it has"},
    {Field::void_fraction_mean, "void_fraction_mean", "1", Type::f64, Shape::scalar, true, true,
     "running mean that transitions are judged by"},
    {Field::temperature_mean, "temperature_mean", "K", Type::f64, Shape::scalar, true, true,
     "running mean that transitions are judged by"},
    {Field::dissolved_gas, "dissolved_gas", "1", Type::f64, Shape::scalar, true, true,
     "w: what of bubbly magma's volatiles is dissolved where that lags behind, per mass of liquid melt"},
    {Field::released_energy, "released_energy", "J", Type::f64, Shape::scalar, true, false,
     "elastic energy that a particle lost by transitions since the start; negative: had from the fluid "
     "beside it"},
    {Field::trial, "trial", "K or Pa", Type::f64, Shape::scalar, false, false,
     "implicit exchange: what is tried for the temperature or the gas pressure, or the change of it"},
    {Field::exchange_sums, "exchange_sums", "W, kg/s", Type::f64, Shape::two, false, false,
     "what flows to a particle if `trial` drove it, and its derivative by the particle's own, negative",
     SumScale::force},
    {Field::gas_slope, "gas_slope", "1/m", Type::f64, Shape::spread, false, false,
     "sums for the gradient that drives gas: over neighbours of its difference [Pa/m], and of squared "
     "distances",
     SumScale::gradient},
    {Field::connected, "connected", "1", Type::u32, Shape::scalar, true, true,
     "1: bubbles have been enough to be connected, and still are"},
    {Field::prestress, "prestress", "Pa", Type::f64, Shape::scalar, true, false,
     "of total-Lagrangian solids in a fluid: pressure in their reference state"},
    {Field::acceleration, "acceleration", "m/s^2", Type::f64, Shape::vector, true, false,
     "of total-Lagrangian solids in a fluid: mean over h / c of the fluid"},
    {Field::bond_force, "bond_force", "N", Type::f64, Shape::vector, false, false,
     "of total-Lagrangian solids in a fluid: their own part of the force"},
    {Field::wet_pressure, "wet_pressure", "Pa", Type::f64, Shape::scalar, false, true,
     "of total-Lagrangian solids: the pressure of the fluid beside them, 0 where there is none"},
    {Field::wet_velocity, "wet_velocity", "m/s", Type::f64, Shape::vector, false, false,
     "... and the velocity with which they seem to continue its flow"},
    {Field::flux_sums, "flux_sums", "1", Type::f64, Shape::two, false, false,
     "of solids and walls beside a fluid: kernel sum over it, sum for the divergence of its flow",
     SumScale::one},
    {Field::flux, "flux", "1", Type::f64, Shape::scalar, false, false,
     "... volume times the second over the first, in units of the sums (terms/wetted.hpp); 0 of fluids"},
    {Field::clamp_sums, "clamp_sums", "1", Type::f64, Shape::clamp, false, false,
     "kernel sums over what is bonded to a clamp's particle: weight, displacement / h, reference distance / "
     "h",
     SumScale::one},
    {Field::clamp_shift, "clamp_shift", "m", Type::f64, Shape::vector, false, false,
     "of a clamp's particle: where bonds see it, less where it is"},
    {Field::clamp_reaction, "clamp_reaction", "N", Type::f64, Shape::vector, false, false,
     "of a clamp's particle: what it gives back of the force on it, a kernel of weight 1"},
    {Field::clamp_push, "clamp_push", "N", Type::f64, Shape::vector, false, false,
     "of a particle that is bonded to clamps: what they give back", SumScale::one},
    {Field::overload, "overload", "1", Type::f64, Shape::scalar, true, true,
     "of solids that can fail: how far beyond their strength they are, over it; below 0 where they hold"},
    {Field::crack, "crack", "1", Type::f64, Shape::vector, true, true,
     "n: where beside a particle of a solid others have failed (terms/crack.hpp); of what has, the normal of "
     "its "
     "crack's plane"},
    {Field::crack_distance, "crack_distance", "1", Type::f64, Shape::scalar, true, false,
     "of what has failed: how far from its plane it was, over the width of bonds"},
    {Field::crack_closing, "crack_closing", "1", Type::f64, Shape::scalar, true, false,
     "of a particle of a solid beside a crack: how much shorter across it that was than in the reference "
     "state when the crack "
     "came"},
    {Field::crack_planes, "crack_planes", "1", Type::f64, Shape::planes, true, false,
     "of a particle of a solid beside what has failed: sums of their planes (terms/crack.hpp)"},
    {Field::failing, "failing", "1", Type::u32, Shape::scalar, true, false,
     "1: has become fluid since cracks were last looked at"},
    {Field::crack_sums, "crack_sums", "1", Type::f64, Shape::cracks, false, false,
     "over bonds: how many are nearly lost, how many lead to what is further beyond its strength; then n "
     "and the planes of what has just failed",
     SumScale::one},
    {Field::borne_by_fluid, "borne_by_fluid", "Pa/m", Type::f64, Shape::symmetric, false, false,
     "of solids that can fail: what of their stress the fluid's pressure bears, over h (terms/crack.hpp)",
     SumScale::gradient},
    {Field::plastic_volume, "plastic_volume", "1", Type::f64, Shape::scalar, true, true,
     "e of a solid with strength: what its pressure does not feel of its volume, p = K (rho (1 + e) / rho_0 "
     "- "
     "1)"},
    {Field::opening, "opening", "1", Type::f64, Shape::scalar, true, true,
     "of a solid with strength: part of plastic_volume that tension opened, and that closes again without "
     "pressure"},
    {Field::plastic_strain, "plastic_strain", "1", Type::f64, Shape::scalar, true, true,
     "of a solid with strength: plastic shear strain, largest less smallest, summed up"},
    {Field::plastic_work, "plastic_work", "J", Type::f64, Shape::scalar, true, false,
     "of a solid with strength: elastic energy that yielding took since the start"},
    {Field::arm, "arm", "m", Type::f64, Shape::vector, true, false,
     "of a rigid body: from its centre of mass at the start"},
    {Field::buffer, "buffer", "1", Type::u32, Shape::scalar, true, true,
     "of the fluid in the box of an inlet the inlet's number, from 1; of that of an outlet with a pressure "
     "the "
     "outlet's, after those; 0: flows freely"},
}};

[[nodiscard]] constexpr const FieldInfo& info(Field f) { return field_table[static_cast<std::size_t>(f)]; }
[[nodiscard]] constexpr int components(Shape s, int dim) {
  switch (s) {
    case Shape::scalar:
      return 1;
    case Shape::two:
      return 2;
    case Shape::four:
      return 4;
    case Shape::vector:
      return dim;
    case Shape::symmetric:
      return dim * (dim + 1) / 2;
    case Shape::matrix:
      return dim * dim;
    case Shape::spread:
      return 1 + dim;
    case Shape::shifting:
      return 2 + dim;
    case Shape::wall:
      return 2 + 2 * dim;
    case Shape::clamp:
      return 1 + 2 * dim;
    case Shape::deformation:
      return 2 + dim * (dim + 1) / 2 + dim * dim;
    case Shape::planes:
      return dim + dim * (dim + 1) / 2;
    case Shape::cracks:
      return 2 + 2 * dim + dim * (dim + 1) / 2;
  }
  return 0;
}
/// Component (a, b) of a symmetric tensor stored xx yy xy or xx yy zz xy xz yz.
[[nodiscard]] constexpr int symmetric_index(int a, int b, int dim) { return a == b ? a : dim + a + b - 1; }
[[nodiscard]] constexpr std::size_t bytes(Type t) { return t == Type::u32 ? 4 : 8; }
[[nodiscard]] constexpr std::size_t width(Field f, int dim) {
  return bytes(info(f).type) * static_cast<std::size_t>(components(info(f).shape, dim));
}

/// A set of fields as a bit mask.
class FieldSet {
 public:
  constexpr FieldSet() = default;
  constexpr FieldSet(std::initializer_list<Field> fields) {
    for (Field f : fields) bits_[word(f)] |= bit(f);
  }
  [[nodiscard]] constexpr bool has(Field f) const { return (bits_[word(f)] & bit(f)) != 0; }
  [[nodiscard]] constexpr bool empty() const { return *this == FieldSet{}; }
  constexpr FieldSet operator|(FieldSet o) const {
    for (std::size_t w = 0; w < words; ++w) o.bits_[w] |= bits_[w];
    return o;
  }
  constexpr FieldSet operator&(FieldSet o) const {
    for (std::size_t w = 0; w < words; ++w) o.bits_[w] &= bits_[w];
    return o;
  }
  constexpr FieldSet without(FieldSet o) const {
    for (std::size_t w = 0; w < words; ++w) o.bits_[w] = bits_[w] & ~o.bits_[w];
    return o;
  }
  constexpr FieldSet& operator|=(FieldSet o) { return *this = *this | o; }
  [[nodiscard]] std::vector<Field> list() const {
    std::vector<Field> out;
    for (const FieldInfo& i : field_table)
      if (has(i.field)) out.push_back(i.field);
    return out;
  }
  friend constexpr bool operator==(FieldSet, FieldSet) = default;

  static constexpr std::size_t words = (static_cast<std::size_t>(field_count) + 63) / 64;
  /// Public only so that a set can be a template argument. Zeros are written out: g++ 12 takes {0, x} for {x} else.
  std::array<std::uint64_t, words> bits_{0, 0};
  static_assert(words == 2, "write out as many zeros as there are words");

 private:
  static constexpr std::size_t word(Field f) { return static_cast<std::size_t>(f) / 64; }
  static constexpr std::uint64_t bit(Field f) { return std::uint64_t{1} << (static_cast<int>(f) % 64); }
};

/// Running averages for output. They migrate and are checkpointed like state, but no step reads them: the
/// fingerprint leaves them out, so that it does not depend on what is written.
inline constexpr FieldSet output_averages{Field::velocity_mean, Field::pressure_mean};

/// Sums that are taken anew before anyone reads them, wherever in a step lists are made: their rows neither move nor
/// migrate.
inline constexpr FieldSet passing_sums{Field::divergence,           Field::diffusion,
                                       Field::velocity_gradient,    Field::wall_sums,
                                       Field::wall_sums_by_density, Field::wall_share};

}  // namespace sph
