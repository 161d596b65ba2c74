// Bubbly magma  rho = rho_l / (1 + xi (rho_l/rho_g - 1)) where m > m_d         Ida (2009) eqs. (12)-(15)
// SPH supplies rho; the pressure is the unique root of v(p) = (1-xi)/rho_l + xi RT/p - 1/rho.
#pragma once

#include <algorithm>

#include "sph/laws/eos/law.hpp"
#include "sph/laws/eos/slow_bubbly.hpp"

namespace sph {

template <class V>
struct BubblyFormulas;

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
  [[nodiscard]] double dissolved(double pressure) const;  ///< m_d = (p/p_s)^gamma: what can be, eq. (14) [1]
  /// dp of a gain dm of gas in a fixed volume, over dm (1 + m) / rho: what a diffusivity of gas flow is made of
  /// [m^2/s^2].
  [[nodiscard]] double gas_stiffness(double pressure) const;
  /// Newton or bisection steps that pressure() takes for this density: for tests.
  [[nodiscard]] int iterations(double density) const;

 private:
  struct Root {
    double pressure;
    int steps;
  };
  [[nodiscard]] Root invert(double density) const;
  [[nodiscard]] BubblyFormulas<double> formulas() const;
  [[nodiscard]] bool is_gas_free(double pressure) const;

  double rho0_, k_, m_, rt_, ps_, gamma_;
  double p_sat_, rho_sat_;
};

/// The equation of state of a bubbly group with this gas content m.
[[nodiscard]] inline BubblyEos bubbly_eos(const Group& g, double gas_content) {
  return {g.density,       g.eos.bulk_modulus,           gas_content,
          g.bubbly.gas_rt, g.bubbly.solubility_pressure, g.bubbly.solubility_exponent};
}

/// Whether the law of a bubbly group has an inverse with this gas content.
[[nodiscard]] inline bool can_hold(const Group& g, double gas_content) {
  try {
    (void)bubbly_eos(g, gas_content);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

/// BubblyEos::gas_stiffness(), of a group that exsolves slowly with what is dissolved.
[[nodiscard]] inline double gas_stiffness(const Group& g, double gas_content, const double* dissolved,
                                          double pressure) {
  return g.bubbly.exsolution_time > 0 ? SlowBubblyEos(g, gas_content, *dissolved).gas_stiffness(pressure)
                                      : bubbly_eos(g, gas_content).gas_stiffness(pressure);
}

/// What of a gas content is dissolved in equilibrium, min(m, m_d).
[[nodiscard]] inline double dissolved_gas(const Group& g, double gas_content, double pressure) {
  if (!(gas_content > 0 && pressure > 0)) return 0;
  return std::min(gas_content, bubbly_eos(g, gas_content).dissolved(pressure));
}

/// BubblyMagma::derive() where what is dissolved follows the pressure: of eight particles at a time, with the bits of one.
void derive_in_equilibrium(const Group& g, const EosRows& rows, std::size_t first, std::size_t last);

struct BubblyMagma : EosLaw {
  static constexpr std::string_view word = "bubbly";
  static constexpr EosKind kind = EosKind::bubbly;
  static constexpr bool constant_sound = false, needs_pressure = true;
  static constexpr std::string_view remedy =
      "without pressure bubbly magma is all gas: raise domain.surface_pressure";

  static void check(const Group& g) { (void)bubbly_eos(g, g.bubbly.gas_content); }
  static void derive(const Group& g, const EosRows& rows, std::size_t first, std::size_t last) {
    if (g.bubbly.exsolution_time > 0) {
      for (std::size_t i = first; i < last; ++i)
        derive_row(SlowBubblyEos(g, rows.gas_content[i], rows.dissolved_gas[i]), rows, i);
      return;
    }
    derive_in_equilibrium(g, rows, first, last);
  }
  template <class Eos>
  static void derive_row(const Eos& eos, const EosRows& rows, std::size_t i) {
    const double absolute = eos.pressure(rows.density[i]);
    rows.pressure[i] = absolute - rows.surface_pressure;
    if (rows.sound_speed != nullptr) rows.sound_speed[i] = eos.sound_speed(absolute);
    if (rows.void_fraction != nullptr) rows.void_fraction[i] = eos.void_fraction(absolute);
  }
  static EosStart start(const Group& g, double above_surface, double surface_pressure) {
    return {density(g, above_surface + surface_pressure)};
  }
  static double density(const Group& g, double pressure) {
    return bubbly_eos(g, g.bubbly.gas_content).density(pressure);
  }
  static double energy(const Group&, double /*density*/) { return 0; }  // not followed
};

}  // namespace sph
