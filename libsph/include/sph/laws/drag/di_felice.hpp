// Di Felice (1994), with the coefficient of Dallavalle (1948), for any porosity e and Reynolds number
// Re = rho e |u - v| d / eta:
//   zeta |u - v| = pi/8 C rho (d e |u - v|)^2 e^-x,   C = (0.63 + 4.8 / sqrt(Re))^2,
//   x = 3.7 - 0.65 exp(-(1.5 - log10 Re)^2 / 2).
// A creeping flow past one sphere drags 4 % less than Stokes has it; a suspension settles as e^4.7.
#pragma once

#include <cmath>
#include <numbers>

#include "sph/core/exact_math.hpp"
#include "sph/laws/drag/law.hpp"

namespace sph {

struct DiFeliceDrag {
  static constexpr std::string_view word = "di_felice";
  static double resistance(const DragState& s) {
    // rho e |u - v| d, that is Re eta, and C Re eta in terms of it: nothing is divided by a speed.
    const double inertia = s.density * s.porosity * s.speed * s.diameter;
    const double root = 0.63 * std::sqrt(inertia) + 4.8 * std::sqrt(s.viscosity);
    const double decades = 1.5 - exact_log(inertia / s.viscosity) / std::numbers::ln10;
    const double x = inertia > 0 && s.viscosity > 0 ? 3.7 - 0.65 * exact_exp(-0.5 * decades * decades) : 3.7;
    return std::numbers::pi / 8 * s.diameter * s.porosity * (root * root) * exact_pow(s.porosity, -x);
  }
};

}  // namespace sph
