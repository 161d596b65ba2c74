// An equation of state of the consumer's own: p = K/gamma ((rho/rho_0)^gamma - 1), Tait's with a whole gamma
// (Cole 1948: 7 for water).
#pragma once

#include "sph/core/exact_math.hpp"
#include "sph/laws/eos/registry.hpp"

struct Tait : sph::BarotropicLaw {
  static constexpr std::string_view word = "tait";
  static constexpr std::array keys{sph::LawKey{"tait_exponent", sph::dimension::none, 1, 15}};

  static double pressure(const sph::Group& g, double density) {
    const double gamma = g.eos.constants[0];
    return g.eos.bulk_modulus / gamma * (sph::exact_pow(density / g.density, gamma) - 1);
  }
  static double density(const sph::Group& g, double pressure) {
    const double gamma = g.eos.constants[0];
    return g.density * sph::exact_pow(1 + gamma * pressure / g.eos.bulk_modulus, 1 / gamma);
  }
  static double sound_speed(const sph::Group& g, double density) {
    const double slope = sph::exact_pow(density / g.density, g.eos.constants[0] - 1);
    return std::sqrt(g.eos.bulk_modulus / g.density * slope);
  }
  static double energy(const sph::Group& g, double density) {
    const double gamma = g.eos.constants[0], x = density / g.density;
    return (sph::exact_pow(x, gamma - 1) / (gamma - 1) + 1 / x - gamma / (gamma - 1)) / gamma;
  }
};
