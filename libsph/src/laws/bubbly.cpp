#include "sph/laws/eos/bubbly.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "laws/bubbly_formulas.hpp"
#include "sph/core/error.hpp"

namespace sph {

namespace {

void require(bool good, const char* what) {
  if (!good) throw InputError(std::string("bubbly equation of state: ") + what);
}

}  // namespace

BubblyEos::BubblyEos(double density, double bulk_modulus, double gas_content, double gas_rt,
                     double solubility_pressure, double solubility_exponent)
    : rho0_(density),
      k_(bulk_modulus),
      m_(gas_content),
      rt_(gas_rt),
      ps_(solubility_pressure),
      gamma_(solubility_exponent),
      p_sat_(0),
      rho_sat_(0) {
  require(density > 0, "density must be > 0");
  require(bulk_modulus > 0, "bulk_modulus must be > 0");
  require(gas_content >= 0, "gas_content must be >= 0");
  if (m_ == 0) return;
  require(gas_rt > 0, "gas_rt must be > 0");
  require(solubility_pressure > 0, "solubility_pressure must be > 0");
  require(solubility_exponent > 0, "solubility_exponent must be > 0");
  const auto [pressure, saturated] = formulas().saturation();
  p_sat_ = pressure;
  rho_sat_ = saturated;
  require(p_sat_ > 0, "the saturation pressure p_s m^(1/gamma) must be > 0");
  // Where the gas is denser than the liquid, rho(p) is not monotonic and has no inverse.
  require(p_sat_ < rt_ * rho_sat_, "p_s m^(1/gamma) / RT, the densest gas, must be lighter than the liquid");
}

bool BubblyEos::is_gas_free(double pressure) const { return m_ == 0 || pressure >= p_sat_; }

BubblyFormulas<double> BubblyEos::formulas() const { return {rho0_, k_, rt_, ps_, gamma_, m_}; }

double BubblyEos::dissolved(double pressure) const { return formulas().dissolved(pressure); }

double BubblyEos::saturation_pressure() const { return p_sat_; }

double BubblyEos::density(double pressure) const {
  if (is_gas_free(pressure)) return rho0_ * (1.0 + pressure / k_);
  return formulas().density(std::max(pressure, 0.0));
}

double BubblyEos::void_fraction(double pressure) const {
  if (is_gas_free(pressure)) return 0;
  return formulas().void_fraction(std::max(pressure, 0.0));
}

double BubblyEos::sound_speed(double pressure) const {
  if (is_gas_free(pressure)) return std::sqrt(k_ / rho0_);
  return formulas().sound_speed(std::max(pressure, 0.0));
}

// d rho = rho / (1 + m) dm in a fixed volume, and at fixed rho dp/dm = rho^2 c^2 (1 + m_d) / (1 + m)^2 (RT/p - 1/rho_l)
// where there is gas: of 1/rho = (1-xi)/rho_l + xi RT/p with d xi/dm = (1 + m_d) / (1 + m)^2.
double BubblyEos::gas_stiffness(double pressure) const {
  const double c = sound_speed(pressure);
  if (is_gas_free(pressure) || !(pressure > 0)) return c * c;
  const double rho = density(pressure), liquid = rho0_ * (1.0 + pressure / k_);
  return c * c * (1.0 + rho * ((1.0 + dissolved(pressure)) / (1.0 + m_)) * (rt_ / pressure - 1.0 / liquid));
}

double BubblyEos::pressure(double density) const { return invert(density).pressure; }

int BubblyEos::iterations(double density) const { return invert(density).steps; }

// Newton on h(p), which falls from rho m RT at p = 0 to below zero at p_sat and has one root; bisection when a step leaves
// the bracket.
BubblyEos::Root BubblyEos::invert(double rho) const {
  if (m_ == 0 || rho >= rho_sat_) return {k_ * ((rho - rho0_) / rho0_), 0};
  if (rho <= 0) return {0, 0};
  const BubblyFormulas<double> f = formulas();
  double low = 0, high = p_sat_;
  double p = std::min(f.first_guess(rho, p_sat_), p_sat_);
  int steps = 0;
  while (p > 0 && steps < most_bubbly_steps) {
    ++steps;
    const auto [h, p_slope] = f.balance(rho, p);
    (h > 0 ? low : high) = p;
    const double next = p - p * (h / p_slope);
    if (std::abs(next - p) <= bubbly_tolerance * p) return {std::clamp(next, low, high), steps};
    p = next > low && next < high ? next : 0.5 * (low + high);
  }
  return {p, steps};
}

}  // namespace sph
