// IdealGas  p = (gamma - 1) rho u, a gas whose internal energy u follows from du = -p dv + heat.
#pragma once

#include <cmath>

#include "sph/laws/eos/law.hpp"

namespace sph {

struct IdealGas {
  double heat_ratio;  ///< gamma
  [[nodiscard]] double pressure(double density, double energy) const {
    return (heat_ratio - 1) * density * energy;
  }
  [[nodiscard]] double energy(double pressure, double density) const {
    return pressure / ((heat_ratio - 1) * density);
  }
  /// sqrt(gamma p / rho)
  [[nodiscard]] double sound_speed(double energy) const {
    return std::sqrt(heat_ratio * (heat_ratio - 1) * energy);
  }
  /// u once the density is `ratio` times what it was, the work being that of the mean of p before and after:
  /// second order in the step, whatever gamma, and as much as the kicks before and after it give to the
  /// motion.
  [[nodiscard]] double compressed(double energy, double ratio) const {
    const double g = 0.5 * (heat_ratio - 1);
    return energy * ((1 - g * (1 / ratio - 1)) / (1 + g * (1 - ratio)));
  }
};

struct IdealGasEos : EosLaw {
  static constexpr std::string_view word = "ideal_gas";
  static constexpr EosKind kind = EosKind::ideal_gas;
  static constexpr bool constant_sound = false;

  static void derive(const Group& g, const EosRows& rows, std::size_t first, std::size_t last) {
    const IdealGas eos{g.eos.gas.heat_ratio};
    for (std::size_t i = first; i < last; ++i) {
      rows.pressure[i] = eos.pressure(rows.density[i], rows.specific_energy[i]) - rows.surface_pressure;
      if (rows.sound_speed != nullptr) rows.sound_speed[i] = eos.sound_speed(rows.specific_energy[i]);
      if (rows.void_fraction != nullptr) rows.void_fraction[i] = 0;
    }
  }
  static EosStart start(const Group& g, double above_surface, double /*surface_pressure*/) {
    return {g.density,
            IdealGas{g.eos.gas.heat_ratio}.energy(g.eos.gas.start_pressure + above_surface, g.density)};
  }
  static double density(const Group& g, double /*pressure*/) { return g.density; }
  static double energy(const Group&, double /*density*/) { return 0; }  // it is state: specific_energy
};

}  // namespace sph
