// Volatiles that a particle of fixed liquid mass M takes in or loses, in the volume that it has: its mass is M (1 + m), and
// density, velocity and enthalpy follow from what they bring.
#pragma once

#include "sph/models/faults.hpp"
#include "sph/models/sph_constants.hpp"

namespace sph {

struct GasContents {
  static constexpr FieldSet reads{Field::gas_gain, Field::gas_heat, Field::liquid_mass};
  static constexpr FieldSet writes{Field::gas_content, Field::mass, Field::density, Field::velocity,
                                   Field::enthalpy};
  using Rows = View<reads, writes>;

  /// Of bubbly groups, from mass and content.
  static void start(const SphConstants& constants, Particles& particles);
  /// The law could not say what the pressure of such a content is; tells it of the particle.
  static bool is_fault(const SphConstants& constants, const FaultView& particles, std::size_t i,
                       double content, const Step& step);
  /// `more` per liquid mass, of which gas_gain and gas_heat tell what it brings in dt; heat from outside besides [J].
  static void take_in(const Rows& particles, std::size_t i, double dt, double more, double heat);
};

}  // namespace sph
