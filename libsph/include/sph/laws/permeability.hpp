// Permeability of bubbly magma against the share of its volume that gas takes, over the coefficient.
#pragma once

#include "sph/core/exact_math.hpp"
#include "sph/scene/fluid_scene.hpp"

namespace sph {

[[nodiscard]] inline double relative_permeability(const Permeability& m, double void_fraction) {
  const double psi = void_fraction;
  switch (m.law) {
    case PermeabilityLaw::power:
      return psi > 0 ? exact_pow(psi, m.exponent) : 0.0;
    case PermeabilityLaw::percolation:
      return psi > m.threshold ? exact_pow(psi - m.threshold, m.exponent) : 0.0;
    case PermeabilityLaw::kozeny_carman:
      break;
  }
  return psi * psi * psi / ((1 - psi) * (1 - psi));
}

}  // namespace sph
