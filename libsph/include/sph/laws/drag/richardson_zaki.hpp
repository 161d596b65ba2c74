// Slow flow: with the porosity e
//   zeta = 3 pi eta d e^-2.65,
// so that a suspension settles as e^4.65 (Richardson & Zaki 1954; Di Felice 1994 at Re = 0), e^2 of which are the
// counterflow and the weight of the mixture.
#pragma once

#include <numbers>

#include "sph/core/exact_math.hpp"
#include "sph/laws/drag/law.hpp"

namespace sph {

struct RichardsonZakiDrag {
  static constexpr std::string_view word = "richardson_zaki";
  static double resistance(const DragState& s) {
    return 3 * std::numbers::pi * s.viscosity * s.diameter * exact_pow(s.porosity, -2.65);
  }
};

}  // namespace sph
