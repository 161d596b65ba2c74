// A drag law of the consumer's own (Schiller & Naumann 1933): zeta = 3 pi eta d (1 + 0.15 Re^0.687), with one
// Reynolds number whatever the porosity.
#pragma once

#include <numbers>

#include "sph/core/exact_math.hpp"
#include "sph/laws/drag/registry.hpp"

struct SchillerNaumann {
  static constexpr std::string_view word = "schiller_naumann";
  static double resistance(const sph::DragState& s) {
    const double reynolds = s.density * s.speed * s.diameter / s.viscosity;
    return 3 * std::numbers::pi * s.viscosity * s.diameter * (1 + 0.15 * sph::exact_pow(reynolds, 0.687));
  }
};
