// Permeability of bubbly magma against the share of its volume that gas takes, over the coefficient; what the inertia of
// fast gas leaves of its flow.
#pragma once

#include <cmath>

#include "sph/core/exact_math.hpp"
#include "sph/scene/fluid_scene.hpp"

namespace sph {

/// `connected`: bubbles have been above the threshold, and not below the closing one since.
[[nodiscard]] inline double relative_permeability(const Permeability& m, double void_fraction,
                                                  bool connected = false) {
  const double psi = void_fraction;
  switch (m.law) {
    case PermeabilityLaw::power:
      return psi > 0 ? exact_pow(psi, m.exponent) : 0.0;
    case PermeabilityLaw::percolation:
      if (const double above = connected ? *m.closing_threshold : m.threshold; psi > above)
        return exact_pow(psi - above, m.exponent);
      return 0;
    case PermeabilityLaw::kozeny_carman:
      break;
  }
  return psi * psi * psi / ((1 - psi) * (1 - psi));
}

/// v over Darcy's, where eta v / k + rho v^2 / k_2 is the gradient (Forchheimer 1901); `permeability` k [m^2].
[[nodiscard]] inline double inertial_share(const Permeability& m, double permeability, double gas_density,
                                           double gradient) {
  if (m.inertial_coefficient == 0 || !(permeability > 0)) return 1;
  const double second = m.inertial_coefficient * exact_pow(permeability, m.inertial_exponent);
  const double slow = permeability / m.gas_viscosity;
  return 2 / (1 + std::sqrt(1 + 4 * gas_density * gradient * slow * slow / second));
}

}  // namespace sph
