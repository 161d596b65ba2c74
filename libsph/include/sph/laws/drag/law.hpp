// What the library asks of a drag law, all of it in the law's one header: the force on a grain per velocity of
// the fluid relative to it, zeta [kg/s], where a fraction `porosity` of the volume around it is fluid:
//
//   struct MyDrag {
//     static constexpr std::string_view word = "my_drag";             // of drag.law
//     static double resistance(const DragState&);                     // zeta
//   };
//
// The force is zeta (u - v), u the velocity of the fluid between the grains; besides it a grain feels the
// fluid's stress over its volume (model A of Gidaspow 1994; Anderson & Jackson 1967): where a law is written
// for both together its force is divided by the porosity. Functions feed the state: no libm but sqrt
// (exact_math.hpp), and finite for any speed, 0 included.
#pragma once

#include <span>
#include <string_view>

namespace sph {

/// Where a grain is. The Reynolds number of most laws is density porosity speed diameter / viscosity.
struct DragState {
  double porosity;   ///< of the mixture around it, above 0
  double speed;      ///< |u - v| [m/s]
  double density;    ///< of the fluid itself [kg/m^3]
  double viscosity;  ///< [Pa s]
  double diameter;   ///< [m]
};

/// A law as code knows it that is not compiled for it (laws/drag/registry.hpp makes it of the struct).
struct DragLaw {
  std::string_view word;
  double (*resistance)(const DragState&);  ///< nullptr: fluid and grains do not act on each other
};

/// All laws; from the first look on none can be added.
[[nodiscard]] std::span<const DragLaw* const> drag_laws();
/// Throws std::logic_error where the word is taken, or laws have been looked at.
void register_drag_law(const DragLaw& law);

}  // namespace sph
