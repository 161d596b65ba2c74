// What a scene says of matter that turns into another: [[group.becomes]].
#pragma once

#include <optional>

namespace sph {

/// A particle joins `group` once its gas's share of the volume or its temperature has been beyond the limit for `hold`.
struct Transition {
  int group = -1;                                                  ///< index
  std::optional<double> void_fraction_above, void_fraction_below;  ///< one of the four ...
  std::optional<double> temperature_above, temperature_below;      ///< ... [K]
  double hold = 0;                                                 ///< [s]
  double average = 0;  ///< the value is a running mean over so long; 0: that of now [s]

  [[nodiscard]] int limits() const {
    int n = 0;
    for (const auto& limit : {void_fraction_above, void_fraction_below, temperature_above, temperature_below})
      n += limit.has_value() ? 1 : 0;
    return n;
  }
  [[nodiscard]] bool of_temperature() const { return temperature_above || temperature_below; }
  [[nodiscard]] bool holds(double void_fraction, double temperature) const {
    if (void_fraction_above) return void_fraction > *void_fraction_above;
    if (void_fraction_below) return void_fraction < *void_fraction_below;
    return temperature_above ? temperature > *temperature_above : temperature < *temperature_below;
  }
  friend bool operator==(const Transition&, const Transition&) = default;
};

}  // namespace sph
