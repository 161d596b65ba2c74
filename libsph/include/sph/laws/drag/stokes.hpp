// Stokes (1851): a sphere alone in a creeping flow,
//   zeta = 3 pi eta d,
// whatever the Reynolds number and however near other grains are.
#pragma once

#include <numbers>

#include "sph/laws/drag/law.hpp"

namespace sph {

struct StokesDrag {
  static constexpr std::string_view word = "stokes";
  static double resistance(const DragState& s) { return 3 * std::numbers::pi * s.viscosity * s.diameter; }
};

}  // namespace sph
