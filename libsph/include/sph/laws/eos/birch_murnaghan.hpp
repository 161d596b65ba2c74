// BirchMurnaghan  p = 3/2 K (x^(7/3) - x^(5/3)) (1 + 3/4 (K' - 4) (x^(2/3) - 1)), x = rho/rho_0, of third
//                 order in the Eulerian strain f = (x^(2/3) - 1) / 2 (Birch 1947); K' = dK/dp at p = 0.
// Rocks and metals under pressure: they stiffen. Stretched beyond a strain that K' sets the law gives way (at
// x = 0.60 for K' = 4, 0.73 for 6); sound is then taken a tenth as fast as at rest, not slower.
#pragma once

#include <algorithm>
#include <cmath>

#include "sph/core/exact_math.hpp"
#include "sph/laws/eos/law.hpp"

namespace sph {

struct BirchMurnaghan : BarotropicLaw {
  static constexpr std::string_view word = "birch_murnaghan";
  // Below 3 the law softens from twice the density on; below 4 it has a largest pressure (10 K with 3.5).
  static constexpr std::array keys{LawKey{
      .name = "bulk_modulus_derivative", .above = 3, .most = 12, .sentence = "K' = dK/dp at no pressure."}};

  static double pressure(const Group& g, double density) {
    const double x = density / g.density, y = exact_pow(x, 1.0 / 3), a = 0.75 * (g.eos.constants[0] - 4);
    return 1.5 * g.eos.bulk_modulus * (x * y * (x - y)) * (1 + a * (y * y - 1));
  }
  static double sound_speed(const Group& g, double density) {
    return std::sqrt(g.eos.bulk_modulus / g.density * std::max(slope(g, density), 0.01));
  }
  static double energy(const Group& g, double density) {
    const double y = exact_pow(density / g.density, 1.0 / 3), f = 0.5 * (y * y - 1);
    return 4.5 * (f * f) * (1 + (g.eos.constants[0] - 4) * f);
  }
  /// Bisection, between what is stretched but has not given way and the linear law's density, above whose
  /// pressure this one is. 0 where no density has that pressure: a start says so.
  static double density(const Group& g, double pressure) {
    constexpr double rounding = 1e-9;  // of K
    double low = 0.9 * g.density, high = g.density * (1 + std::max(pressure, 0.0) / g.eos.bulk_modulus);
    while (BirchMurnaghan::pressure(g, low) > pressure && slope(g, 0.98 * low) > 0) low *= 0.98;
    if (BirchMurnaghan::pressure(g, low) > pressure ||
        BirchMurnaghan::pressure(g, high) < pressure - rounding * g.eos.bulk_modulus)
      return 0;
    for (int k = 0; k < 64; ++k) {
      const double middle = 0.5 * (low + high);
      (BirchMurnaghan::pressure(g, middle) < pressure ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

 private:
  /// dp/drho over K/rho_0.
  static double slope(const Group& g, double density) {
    const double y = exact_pow(density / g.density, 1.0 / 3), y2 = y * y, a = 0.75 * (g.eos.constants[0] - 4);
    return y2 * ((7 * y2 - 5) * (1 + a * (y2 - 1)) + 2 * a * y2 * (y2 - 1)) / 2;
  }
};

}  // namespace sph
