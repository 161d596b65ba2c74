// Quantities as people write them: "5 mm", "2500 kg/m3", "500 Pa s", "9.8 m/s^2". The unit is checked against
// the dimension that a key wants. Decimal prefixes move the decimal exponent before the number is read, so
// "9.3 mm" is the same double as 0.0093.
#pragma once

#include <string>
#include <string_view>

namespace sph {

/// Exponents of kilogram, metre and second.
struct Dimension {
  int kg = 0;
  int m = 0;
  int s = 0;
  friend bool operator==(const Dimension&, const Dimension&) = default;
};

namespace dimension {
inline constexpr Dimension none{};
inline constexpr Dimension length{0, 1, 0};
inline constexpr Dimension time{0, 0, 1};
inline constexpr Dimension speed{0, 1, -1};
inline constexpr Dimension acceleration{0, 1, -2};
inline constexpr Dimension density{1, -3, 0};
inline constexpr Dimension pressure{1, -1, -2};
inline constexpr Dimension viscosity{1, -1, -1};
inline constexpr Dimension specific_energy{0, 2, -2};
inline constexpr Dimension force{1, 1, -2};
inline constexpr Dimension stiffness{1, 0, -2};
inline constexpr Dimension rate{0, 0, -1};
inline constexpr Dimension rate_squared{0, 0, -2};
inline constexpr Dimension speed_per_force{-1, 0, 1};
}  // namespace dimension

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
