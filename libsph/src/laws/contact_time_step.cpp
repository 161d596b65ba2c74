#include <cmath>
#include <numbers>

#include "sph/core/exact_math.hpp"
#include "sph/laws/contact/time_step.hpp"

namespace sph {

double linear_contact_time(double stiffness, double mass) {
  return std::numbers::pi * std::sqrt(mass / stiffness);
}

double linear_stable_step(double stiffness, double mass, double zeta) {
  // sqrt(1 + zeta^2) - zeta without cancellation.
  return 2.0 / (std::sqrt(1.0 + zeta * zeta) + zeta) * std::sqrt(mass / stiffness);
}

double packing_step(double stiffness, double mass) { return 0.17 * std::sqrt(mass / stiffness); }

double hertz_overlap(double modulus, double radius, double mass, double speed) {
  return exact_pow(15.0 * mass * speed * speed / (16.0 * modulus * std::sqrt(radius)), 0.4);
}

double hertz_contact_time(double modulus, double radius, double mass, double speed) {
  // 2 int_0^1 dx / sqrt(1 - x^(5/2)) = 4 sqrt(pi) Gamma(2/5) / (5 Gamma(9/10))
  constexpr double duration = 2.9432751843247043;
  return duration * hertz_overlap(modulus, radius, mass, speed) / speed;
}

double rayleigh_time(double radius, double density, double young_modulus, double poisson_ratio) {
  const double shear_modulus = young_modulus / (2.0 * (1.0 + poisson_ratio));
  return std::numbers::pi * radius * std::sqrt(density / shear_modulus) / (0.1631 * poisson_ratio + 0.8766);
}

}  // namespace sph
