// What a scene says of matter that turns into another: [[group.becomes]].
#pragma once

#include <cstdint>
#include <optional>

namespace sph {

/// What a total-Lagrangian solid bears (models/failure.hpp).
struct FailureLimits {
  std::optional<double> toughness;         ///< K_Ic [Pa sqrt(m)], or ...
  std::optional<double> tensile_strength;  ///< ... of a particle, at any spacing [Pa]
  std::optional<double> cohesion;          ///< of Mohr and Coulomb, besides [Pa]
  double friction_angle = 0;               ///< of that [degrees]
  friend bool operator==(const FailureLimits&, const FailureLimits&) = default;
};

/// Of what fails: the pressure is that of the fluid beside it, or with mass and volume both what follows from these.
enum class Conserved : std::uint8_t { mass, volume, both };

/// A particle joins `group` once its gas's share of the volume or its temperature has been beyond the limit for `hold`.
struct Transition {
  int group = -1;                                                  ///< index
  std::optional<double> void_fraction_above, void_fraction_below;  ///< one of the four ...
  std::optional<double> temperature_above, temperature_below;      ///< ... [K]
  FailureLimits failure;                                           ///< ... of a total-Lagrangian solid
  Conserved keeps = Conserved::mass;
  double hold = 0;     ///< [s]
  double average = 0;  ///< the value, or the overload, is a running mean over so long; 0: that of now [s]

  [[nodiscard]] int limits() const {
    int n = 0;
    for (const auto& limit : {void_fraction_above, void_fraction_below, temperature_above, temperature_below})
      n += limit.has_value() ? 1 : 0;
    return n + (of_failure() ? 1 : 0);
  }
  [[nodiscard]] bool of_failure() const {
    return failure.toughness || failure.tensile_strength || failure.cohesion;
  }
  /// By a mean that is a field of its own.
  [[nodiscard]] bool of_mean() const { return average > 0 && !of_failure(); }
  [[nodiscard]] bool of_temperature() const { return temperature_above || temperature_below; }
  [[nodiscard]] bool holds(double void_fraction, double temperature) const {
    if (void_fraction_above) return void_fraction > *void_fraction_above;
    if (void_fraction_below) return void_fraction < *void_fraction_below;
    return temperature_above ? temperature > *temperature_above : temperature < *temperature_below;
  }
  friend bool operator==(const Transition&, const Transition&) = default;
};

}  // namespace sph
