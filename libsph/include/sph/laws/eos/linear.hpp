// LinearEos  p = K (rho/rho_0 - 1)                                     Ida (2009) eq. (10), p_0 = 0
#pragma once

#include <cmath>

#include "sph/core/exact_math.hpp"
#include "sph/laws/eos/law.hpp"

namespace sph {

struct LinearEos : BarotropicLaw {
  static constexpr std::string_view word = "linear";
  static constexpr bool constant_sound = true;

  static double pressure(const Group& g, double density) {
    return g.eos.bulk_modulus * ((density - g.density) / g.density);
  }
  static double density(const Group& g, double pressure) {
    return g.density * (1 + pressure / g.eos.bulk_modulus);
  }
  static double sound_speed(const Group& g, double /*density*/) {
    return std::sqrt(g.eos.bulk_modulus / g.density);
  }

  /// ln(1+s) - s/(1+s), s = rho/rho_0 - 1. The closed form cancels for small s, where its series
  /// sum (-1)^k (k-1)/k s^k is good to rounding.
  static double energy(const Group& g, double density) {
    constexpr double small = 0.03125;
    constexpr int last_power = 12;
    const double s = (density - g.density) / g.density;
    if (!(std::fabs(s) < small)) return exact_log(1 + s) - s / (1 + s);
    double sum = 0;
    for (int k = last_power; k >= 2; --k) sum = (k % 2 == 0 ? 1.0 : -1.0) * (k - 1) / k + s * sum;
    return s * s * sum;
  }

  /// p = (K + p_top) (exp(rho_0 g d / K) - 1) + p_top
  static double pressure_below(const Group& g, const StillLayer& at) {
    return at.pressure + (g.eos.bulk_modulus + at.surface_pressure + at.pressure) *
                             (exact_exp(g.density * at.gravity * at.depth / g.eos.bulk_modulus) - 1);
  }
};

}  // namespace sph
