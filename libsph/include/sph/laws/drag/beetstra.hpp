// Slow flow through spheres at random, from lattice-Boltzmann simulations (Beetstra, van der Hoef & Kuipers 2007, at Re = 0;
// van der Hoef et al. 2005): with the porosity e and phi = 1 - e
//   zeta = 3 pi eta d e [10 phi / e^2 + e^2 (1 + 1.5 sqrt(phi))].
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sph/laws/drag/law.hpp"

namespace sph {

struct BeetstraDrag {
  static constexpr std::string_view word = "beetstra";
  static double resistance(const DragState& s) {
    const double e = s.porosity, phi = 1 - e, square = e * e;
    return 3 * std::numbers::pi * s.viscosity * s.diameter * e *
           (10 * phi / square + square * (1 + 1.5 * std::sqrt(std::max(phi, 0.0))));
  }
};

}  // namespace sph
