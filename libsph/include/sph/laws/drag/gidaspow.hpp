// Gidaspow (1994): Ergun (1952) in dense beds, porosity e below 0.8,
//   zeta / V = 150 (1 - e) eta / (e d^2) + 1.75 rho |u - v| / d,    V = pi/6 d^3,
// and Wen & Yu (1966) above it, with Re = rho e |u - v| d / eta,
//   zeta / V = 3/4 C rho e |u - v| / d e^-2.65,   C = 24 / Re (1 + 0.15 Re^0.687), above Re = 1000 it is 0.44.
// The two do not meet at e = 0.8.
#pragma once

#include <numbers>

#include "sph/core/exact_math.hpp"
#include "sph/laws/drag/law.hpp"

namespace sph {

struct GidaspowDrag {
  static constexpr std::string_view word = "gidaspow";
  static double resistance(const DragState& s) {
    const double d = s.diameter, e = s.porosity, volume = std::numbers::pi / 6 * d * d * d;
    if (e < 0.8) return volume * (150 * (1 - e) * s.viscosity / (e * d * d) + 1.75 * s.density * s.speed / d);
    const double inertia = s.density * e * s.speed * d;  // Re eta
    const double drag =                                  // C rho e |u - v| / d
        inertia < 1000 * s.viscosity
            ? 24 * s.viscosity / (d * d) * (1 + 0.15 * exact_pow(inertia / s.viscosity, 0.687))
            : 0.44 * inertia / (d * d);
    return volume * 0.75 * drag * exact_pow(e, -2.65);
  }
};

}  // namespace sph
