// Pressure and what else follows from the state of a particle alone, by its group's equation of state.
#pragma once

#include "sph/models/faults.hpp"
#include "sph/models/sph_constants.hpp"

namespace sph {

class Materials {
 public:
  static constexpr FieldSet reads{Field::density,         Field::group,    Field::gas_content,
                                  Field::specific_energy, Field::porosity, Field::liquid_density,
                                  Field::dissolved_gas,   Field::position, Field::plastic_volume};
  static constexpr FieldSet writes{Field::pressure, Field::sound_speed, Field::void_fraction,
                                   Field::liquid_density};

  explicit Materials(const SphConstants& constants) : constants_(&constants) {}
  /// Of rows [first, last).
  void derive(const View<reads, writes>& particles, std::size_t first, std::size_t last) const;
  /// The pressure alone, where the rest is what it was.
  using Pressures = View<reads, FieldSet{Field::pressure}>;
  void derive_pressure(const Pressures& particles, std::size_t first, std::size_t last) const;

  /// Of a particle were it of this group, with this gas content, at the pressure that it has [kg/m^3].
  using AtPressure =
      View<FaultView::reads | FieldSet{Field::pressure, Field::porosity, Field::dissolved_gas}, FieldSet{}>;
  [[nodiscard]] double density_of(const AtPressure& particles, std::size_t i, const Group& group,
                                  double gas_content, const Step& step) const;
  /// What its equation of state sees besides its pressure [Pa].
  using Placed = View<FieldSet{Field::position, Field::group}, FieldSet{}>;
  [[nodiscard]] double outer(const Placed& particles, std::size_t i, const Group& group) const;

 private:
  template <class V>
  void derive_into(const V& particles, std::size_t first, std::size_t last) const;

  const SphConstants* constants_;
};

}  // namespace sph
