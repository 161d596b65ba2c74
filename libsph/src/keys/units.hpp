// Quantities as people write them: "5 mm", "2500 kg/m3", "500 Pa s", "9.8 m/s^2". The unit is checked against
// the dimension that a key wants. Decimal prefixes move the decimal exponent before the number is read, so
// "9.3 mm" is the same double as 0.0093.
#pragma once

#include <string>
#include <string_view>

#include "sph/core/dimension.hpp"

namespace sph {

/// Either a value in SI with its dimension, or what is wrong with the text.
struct Quantity {
  double value = 0;
  Dimension dim;
  bool has_unit = false;
  std::string problem;  ///< empty if the text could be read
};

[[nodiscard]] Quantity parse_quantity(std::string_view text);
/// "a pressure (Pa)"
[[nodiscard]] std::string describe(Dimension dim);
/// The SI unit, "Pa"; "1" without dimension.
[[nodiscard]] std::string si_unit(Dimension dim);

}  // namespace sph
