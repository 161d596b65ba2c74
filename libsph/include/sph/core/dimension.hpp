// The dimensions that quantities of a scene have.
#pragma once

namespace sph {

/// Exponents of kilogram, metre, second and kelvin.
struct Dimension {
  int kg = 0;
  int m = 0;
  int s = 0;
  int kelvin = 0;
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
inline constexpr Dimension mass{1, 0, 0};
inline constexpr Dimension force{1, 1, -2};
inline constexpr Dimension stiffness{1, 0, -2};
inline constexpr Dimension rate{0, 0, -1};
inline constexpr Dimension rate_squared{0, 0, -2};
inline constexpr Dimension speed_per_force{-1, 0, 1};
inline constexpr Dimension diffusivity{0, 2, -1};
inline constexpr Dimension temperature{0, 0, 0, 1};
inline constexpr Dimension per_temperature{0, 0, 0, -1};
inline constexpr Dimension temperature_flux{0, 1, -1, 1};
inline constexpr Dimension area{0, 2, 0};
inline constexpr Dimension specific_heat{0, 2, -2, -1};
inline constexpr Dimension conductivity{1, 1, -3, -1};
inline constexpr Dimension mass_rate{1, 0, -1};
inline constexpr Dimension heat_flux{1, 0, -3};
inline constexpr Dimension heat_transfer{1, 0, -3, -1};
}  // namespace dimension

}  // namespace sph
