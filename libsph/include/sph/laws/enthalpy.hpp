// Enthalpy of a mass unit against its temperature: c T, and from solidus to liquidus the latent heat besides, spread
// evenly (the enthalpy method: Voller & Cross 1981). Increasing and piecewise linear, so each gives the other.
#pragma once

#include "sph/scene/heat_scene.hpp"

namespace sph {

[[nodiscard]] inline double enthalpy(const HeatMaterial& m, double temperature) {
  const double sensible = m.specific_heat * temperature;
  if (m.latent_heat == 0 || temperature <= m.solidus) return sensible;
  if (temperature >= m.liquidus) return sensible + m.latent_heat;
  return sensible + m.latent_heat * ((temperature - m.solidus) / (m.liquidus - m.solidus));
}

/// What of a mass is molten.
[[nodiscard]] inline double liquid_share(const HeatMaterial& m, double temperature) {
  if (m.latent_heat == 0 || temperature >= m.liquidus) return 1;
  return temperature <= m.solidus ? 0.0 : (temperature - m.solidus) / (m.liquidus - m.solidus);
}

/// Derivative of enthalpy() by T, at the enthalpy given [J/kg/K].
[[nodiscard]] inline double heat_capacity(const HeatMaterial& m, double enthalpy) {
  const double first = m.specific_heat * m.solidus, last = m.specific_heat * m.liquidus + m.latent_heat;
  const bool freezes = m.latent_heat > 0 && enthalpy > first && enthalpy < last;
  return freezes ? (last - first) / (m.liquidus - m.solidus) : m.specific_heat;
}

/// Inverse of enthalpy() [K].
[[nodiscard]] inline double temperature(const HeatMaterial& m, double enthalpy) {
  const double first = m.specific_heat * m.solidus, last = m.specific_heat * m.liquidus + m.latent_heat;
  if (m.latent_heat == 0 || enthalpy <= first) return enthalpy / m.specific_heat;
  if (enthalpy >= last) return (enthalpy - m.latent_heat) / m.specific_heat;
  return m.solidus + (m.liquidus - m.solidus) * ((enthalpy - first) / (last - first));
}

}  // namespace sph
