// What a scene has of quantities that particles exchange, and what of them came from outside since the start: the
// difference stays what it was, but for rounding.
#pragma once

#include <string>
#include <vector>

#include "sph/core/particles.hpp"

namespace sph {

struct Budget {
  /// One sum each, in the order of visit().
  [[nodiscard]] static std::vector<std::string> names(const Particles& p) {
    std::vector<std::string> out{"mass"};
    if (p.has(Field::mass_inflow)) out.emplace_back("mass_added");
    if (p.has(Field::enthalpy)) out.emplace_back("heat");
    if (p.has(Field::heat_inflow)) out.emplace_back("heat_in");
    if (has_gas(p)) out.emplace_back("gas");
    if (p.has(Field::gas_inflow)) out.emplace_back("gas_in");
    if (p.has(Field::released_energy)) out.emplace_back("released");
    return out;
  }
  /// Counts what has come from outside.
  [[nodiscard]] static bool is_inflow(const std::string& name) {
    return name == "mass_added" || name == "heat_in" || name == "gas_in" || name == "released";
  }
  /// Of one particle that is no wall [kg, kg, J, J, kg, kg, J].
  template <class Add>
  static void visit(const Particles& p, std::size_t row, Add&& add) {
    const double mass = p.data<Field::mass>()[row];
    add(mass);
    if (const double* inflow = p.data<Field::mass_inflow>()) add(inflow[row]);
    if (const double* h = p.data<Field::enthalpy>()) add(mass * h[row]);
    if (const double* inflow = p.data<Field::heat_inflow>()) add(inflow[row]);
    if (has_gas(p)) {
      const double m = p.data<Field::gas_content>()[row];
      const double* liquid = p.data<Field::liquid_mass>();
      add(m * (liquid != nullptr ? liquid[row] : mass / (1 + m)));
    }
    if (const double* inflow = p.data<Field::gas_inflow>()) add(inflow[row]);
    if (const double* energy = p.data<Field::released_energy>()) add(energy[row]);
  }

 private:
  [[nodiscard]] static bool has_gas(const Particles& p) {
    return p.has(Field::liquid_mass) || p.has(Field::gas_inflow);
  }
};

}  // namespace sph
