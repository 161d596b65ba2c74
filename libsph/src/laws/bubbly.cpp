// Everything is written with p/rho instead of 1/rho, so that nothing divides by a pressure or overflows as
// the gas gets thin: p/rho = (1-xi) p/rho_l + xi RT, with 1-xi = (1+m_d)/(1+m) and xi = (m-m_d)/(1+m).
#include "sph/laws/eos/bubbly.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "sph/core/error.hpp"
#include "sph/core/exact_math.hpp"

namespace sph {

namespace {

// Newton's last step is below this, so that the next one would change p by its square: round-off.
constexpr double step_tolerance = 1e-8;
constexpr int most_steps = 100;  // a backstop: tests see at most 10, and at most 4 for 0.5 <= gamma <= 1.5

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
  if (gamma_ == 1)
    p_sat_ = ps_ * m_;
  else if (gamma_ == 0.5)
    p_sat_ = ps_ * (m_ * m_);
  else
    p_sat_ = ps_ * exact_pow(m_, 1.0 / gamma_);
  rho_sat_ = rho0_ * (1.0 + p_sat_ / k_);
  require(p_sat_ > 0, "the saturation pressure p_s m^(1/gamma) must be > 0");
  // Where the gas is denser than the liquid, rho(p) is not monotonic and has no inverse.
  require(p_sat_ < rt_ * rho_sat_, "p_s m^(1/gamma) / RT, the densest gas, must be lighter than the liquid");
}

bool BubblyEos::is_gas_free(double pressure) const { return m_ == 0 || pressure >= p_sat_; }

double BubblyEos::dissolved(double pressure) const {
  const double ratio = pressure / ps_;
  if (gamma_ == 1) return ratio;
  if (gamma_ == 0.5) return std::sqrt(ratio);
  return exact_pow(ratio, gamma_);
}

double BubblyEos::saturation_pressure() const { return p_sat_; }

double BubblyEos::density(double pressure) const {
  if (is_gas_free(pressure)) return rho0_ * (1.0 + pressure / k_);
  const double p = std::max(pressure, 0.0);
  const double md = dissolved(p);
  const double liquid = (1.0 + md) * (p / (rho0_ * (1.0 + p / k_)));
  const double gas = std::max(m_ - md, 0.0) * rt_;
  return (1.0 + m_) * (p / (liquid + gas));
}

double BubblyEos::void_fraction(double pressure) const {
  if (is_gas_free(pressure)) return 0;
  const double p = std::max(pressure, 0.0);
  const double md = dissolved(p);
  const double liquid = (1.0 + md) * (p / (rho0_ * (1.0 + p / k_)));
  const double gas = std::max(m_ - md, 0.0) * rt_;
  return gas / (liquid + gas);
}

// With e = p/rho, c^2 = dp/drho = e^2 / (e - p de/dp).
double BubblyEos::sound_speed(double pressure) const {
  if (is_gas_free(pressure)) return std::sqrt(k_ / rho0_);
  const double p = std::max(pressure, 0.0);
  const double md = dissolved(p);
  const double compression = 1.0 + p / k_;
  const double p_by_rho_l = p / (rho0_ * compression);
  const double gas = std::max(m_ - md, 0.0) * rt_;
  const double e = (1.0 + md) * p_by_rho_l + gas;
  const double stiffness = (1.0 + md) * p_by_rho_l * (p / k_) / compression + gas;
  const double exsolution = gamma_ * md * (rt_ - p_by_rho_l);
  return e / std::sqrt((1.0 + m_) * (stiffness + exsolution));
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

// Closed form with rho_l = rho_0. In y = p/p_sat and neglecting the volume change of the melt by dissolution,
// y^gamma + a y = 1 with a = ((1+m)/rho - 1/rho_0) p_sat/(m RT); 1/a is the dilute limit. All times rho.
double BubblyEos::first_guess(double rho) const {
  const double free = std::max((1.0 + m_) - rho / rho0_, 0.0);
  const double gas = rho * m_ * rt_;
  if (gamma_ == 1) {
    // Exact for rho_l = rho_0: p^2/(p_s rho_0) - B p + m RT = 0, the stable root.
    const double b = free + rho * (rt_ / ps_);
    const double root = std::sqrt(std::max(b * b - 4.0 * gas * (rho / (ps_ * rho0_)), 0.0));
    return 2.0 * gas / (b + root);
  }
  if (gamma_ == 0.5) {
    // free p + (rho RT/sqrt(p_s)) sqrt(p) = gas
    const double b = rho * rt_ / std::sqrt(ps_);
    const double s = 2.0 * gas / (b + std::sqrt(b * b + 4.0 * free * gas));
    return s * s;
  }
  // The root for gamma = 1, right in both limits for any gamma.
  return gas * (p_sat_ / (gas + free * p_sat_));
}

// Newton on h(p) = rho ((1+m_d) p/rho_l + (m-m_d) RT) - (1+m) p, which falls from rho m RT at p = 0 to below
// zero at p_sat and has one root; bisection when a step leaves the bracket.
BubblyEos::Root BubblyEos::invert(double rho) const {
  if (m_ == 0 || rho >= rho_sat_) return {k_ * ((rho - rho0_) / rho0_), 0};
  if (rho <= 0) return {0, 0};
  double low = 0, high = p_sat_;
  double p = std::min(first_guess(rho), p_sat_);
  int steps = 0;
  while (p > 0 && steps < most_steps) {
    ++steps;
    const double md = dissolved(p);
    const double compression = 1.0 + p / k_;
    const double p_by_rho_l = p / (rho0_ * compression);
    const double h = rho * ((1.0 + md) * p_by_rho_l + (m_ - md) * rt_) - (1.0 + m_) * p;
    const double p_slope = rho * ((1.0 + md) * p_by_rho_l / compression + gamma_ * md * (p_by_rho_l - rt_)) -
                           (1.0 + m_) * p;  // p dh/dp
    (h > 0 ? low : high) = p;
    const double next = p - p * (h / p_slope);
    if (std::abs(next - p) <= step_tolerance * p) return {std::clamp(next, low, high), steps};
    p = next > low && next < high ? next : 0.5 * (low + high);
  }
  return {p, steps};
}

}  // namespace sph
