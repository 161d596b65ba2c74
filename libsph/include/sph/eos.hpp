// Equations of state. Pressures here are absolute; the momentum equation uses them less the surface pressure.
//   linear  p = K (rho/rho_0 - 1)                                     Ida (2009) eq. (10), p_0 = 0
//   ideal_gas  p = (gamma - 1) rho u
//   bubbly  rho = rho_l / (1 + xi (rho_l/rho_g - 1)) where m > m_d    Ida eqs. (12)-(15)
// SPH supplies rho; the bubbly pressure is the unique root of v(p) = (1-xi)/rho_l + xi RT/p - 1/rho.
#pragma once

#include "sph/scene.hpp"

namespace sph {

/// Bubbly magma. All functions are pure, finite for every finite positive argument and free of libm.
/// With gas_content 0 the linear law, tension included; otherwise pressure(rho) > 0 for every rho > 0.
class BubblyEos {
 public:
  /// Throws InputError where rho(p) has no inverse (the gas at saturation denser than the liquid).
  BubblyEos(double density, double bulk_modulus, double gas_content, double gas_rt,
            double solubility_pressure, double solubility_exponent);
  [[nodiscard]] double saturation_pressure() const;           ///< p_s m^(1/gamma) [Pa]
  [[nodiscard]] double density(double pressure) const;        ///< eqs. (13)-(15) [kg/m^3]
  [[nodiscard]] double pressure(double density) const;        ///< inverse of density() [Pa]
  [[nodiscard]] double void_fraction(double pressure) const;  ///< psi, eq. (14) [1]
  [[nodiscard]] double sound_speed(double pressure) const;    ///< sqrt(dp/drho) [m/s]
  /// Newton or bisection steps that pressure() takes for this density: for tests.
  [[nodiscard]] int iterations(double density) const;

 private:
  struct Root {
    double pressure;
    int steps;
  };
  [[nodiscard]] Root invert(double density) const;
  [[nodiscard]] double first_guess(double density) const;
  [[nodiscard]] double dissolved(double pressure) const;  ///< m_d = (p/p_s)^gamma, Ida eq. (14)
  [[nodiscard]] bool is_gas_free(double pressure) const;

  double rho0_, k_, m_, rt_, ps_, gamma_;
  double p_sat_, rho_sat_;
};

/// A gas whose internal energy u follows from du = -p dv + heat.
struct IdealGas {
  double heat_ratio;  ///< gamma
  [[nodiscard]] double pressure(double density, double energy) const {
    return (heat_ratio - 1) * density * energy;
  }
  [[nodiscard]] double energy(double pressure, double density) const {
    return pressure / ((heat_ratio - 1) * density);
  }
  [[nodiscard]] double sound_speed(double energy) const;  ///< sqrt(gamma p / rho)
  /// u once the density is `ratio` times what it was, the work being that of the mean of p before and after:
  /// second order in the step, whatever gamma, and as much as the kicks before and after it give to the
  /// motion.
  [[nodiscard]] double compressed(double energy, double ratio) const {
    const double g = 0.5 * (heat_ratio - 1);
    return energy * ((1 - g * (1 / ratio - 1)) / (1 + g * (1 - ratio)));
  }
};

/// The equation of state of a bubbly group with this gas content m.
[[nodiscard]] inline BubblyEos bubbly_eos(const Group& g, double gas_content) {
  return {g.density, g.bulk_modulus, gas_content, g.gas_rt, g.solubility_pressure, g.solubility_exponent};
}

}  // namespace sph
