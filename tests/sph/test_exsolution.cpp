// Volatiles that leave the melt slowly: the law of a given dissolved content, and how that follows the pressure.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "sph/laws/eos/bubbly.hpp"
#include "sph/step/simulation.hpp"

namespace {

using sph::Field;
using sph::Group;
using sph::Simulation;
using sph::SlowBubblyEos;

const decomp::Comm& world() {
  static const decomp::Comm comm(MPI_COMM_WORLD);
  return comm;
}

Group magma(double gamma) {
  Group g;
  g.density = 2500;
  g.eos.bulk_modulus = 1e9;
  g.bubbly.gas_content = 0.02;
  g.bubbly.gas_rt = 5e5;
  g.bubbly.solubility_pressure = gamma == 0.5 ? 5.92e10 : 1e9;
  g.bubbly.solubility_exponent = gamma;
  return g;
}

TEST(SlowBubbly, IsTheBubblyLawInEquilibrium) {
  for (const double gamma : {1.0, 0.5, 0.7})
    for (const double p : {1e4, 1e5, 3e6, 1.1e7, 1e8}) {
      const Group g = magma(gamma);
      const sph::BubblyEos at_rest = bubbly_eos(g, 0.02);
      const SlowBubblyEos eos(g, 0.02, dissolved_gas(g, 0.02, p));
      const double rho = at_rest.density(p);
      EXPECT_NEAR(eos.density(p), rho, 1e-12 * rho);
      EXPECT_NEAR(eos.pressure(rho), p, 1e-9 * (p + 1e6));
      EXPECT_NEAR(eos.void_fraction(p), at_rest.void_fraction(p), 1e-12);
      EXPECT_GE(eos.sound_speed(p), at_rest.sound_speed(p));
    }
}

TEST(SlowBubbly, HasTheDerivativesOfItself) {
  const Group g = magma(1);
  for (const double w : {0.0, 0.001, 0.0199})
    for (const double p : {1e5, 3e6, 1e8}) {
      const SlowBubblyEos eos(g, 0.02, w);
      const double rho = eos.density(p), d = 1e-5;
      EXPECT_NEAR(eos.pressure(rho), p, 1e-9 * p);
      const double c2 = (eos.pressure(rho * (1 + d)) - eos.pressure(rho * (1 - d))) / (2 * d * rho);
      EXPECT_NEAR(eos.sound_speed(p) * eos.sound_speed(p), c2, 1e-6 * c2);
      const double relief =
          (SlowBubblyEos(g, 0.02, w).pressure(rho) - SlowBubblyEos(g, 0.02, w + 1e-9).pressure(rho)) / 1e-9;
      EXPECT_NEAR(eos.relief(p), relief, 1e-3 * relief);
      const double dm = 1e-9, more = rho * (1.02 + dm) / 1.02;
      const double gain =
          (SlowBubblyEos(g, 0.02 + dm, w).pressure(more) - eos.pressure(rho)) / (rho * dm / 1.02);
      EXPECT_NEAR(eos.gas_stiffness(p), gain, 1e-3 * gain);
    }
  // All dissolved: the liquid, torn or not.
  const SlowBubblyEos liquid(g, 0.02, 0.02);
  EXPECT_NEAR(liquid.pressure(2490), -4e6, 1e-3);
  EXPECT_EQ(liquid.void_fraction(-4e6), 0);
  EXPECT_NEAR(liquid.density(-4e6), 2490, 1e-9);
}

/// Saturated at 10 bar, it becomes another in which half as much can be dissolved, at rest and at constant density.
std::string sealed(double tau, double modulus) {
  const auto group = [&](const std::string& name, const std::string& solubility, const std::string& more) {
    return "[[group]]\nname = \"" + name +
           "\"\nkind = \"fluid\"\neos = \"bubbly\"\ndensity = 2500\nbulk_modulus = " +
           std::to_string(modulus) +
           "\ngas_content = 0.001\ngas_rt = 5e5\nsolubility_pressure = " + solubility +
           "\ntemperature = 1000\nheat = { specific_heat = 1000 }\n" + more;
  };
  return "[domain]\nlower = [0, 0]\nupper = [12, 12]\nperiodic = [true, true]\nsurface_pressure = "
         "1e6\n[kernel]\n"
         "h_over_dx = 1.0\n" +
         group("old", "1e9", "becomes = [{ group = \"new\", temperature_below = 1001 }]\n") +
         group("new", "2e9", "exsolution_time = " + std::to_string(std::llround(1e9 * tau)) + "e-9\n") +
         "[start]\nspacing = 1\n[[start.region]]\ngroup = \"old\"\n[terms]\nmotion = false\n[time]\nsteps = "
         "1\ndt = "
         "0.01\n";
}

struct Sealed {
  double dissolved, pressure;
};
Sealed after(double tau, double modulus, int steps) {
  Simulation s(world(), sph::parse_scene(sealed(tau, modulus), "sealed", {}));
  for (int k = 0; k <= steps; ++k) s.step();  // in the first it becomes the other
  const sph::Particles& p = s.particles();
  Sealed out{0, 0};
  for (std::size_t i = 0; i < p.owned(); ++i)
    out = {p.data<Field::dissolved_gas>()[i], p.data<Field::pressure>()[i] + 1e6};
  return out;
}

// Against the equation, solved in small steps.
TEST(Exsolution, FollowsItsEquation) {
  for (const double modulus : {1e8, 1e10})
    for (const double tau : {10.0, 1.0, 0.2}) {
      const Sealed found = after(tau, modulus, 100);
      if (found.dissolved == 0) continue;  // this rank has no particle
      Group g = magma(1);
      g.eos.bulk_modulus = modulus;
      g.bubbly.solubility_pressure = 2e9;
      const double rho = 2500 * (1 + 1e6 / modulus);
      double w = 0.001;
      const auto rate = [&](double at) {
        return (dissolved_gas(g, 0.001, SlowBubblyEos(g, 0.001, at).pressure(rho)) - at) / tau;
      };
      constexpr int fine = 400000;
      for (int k = 0; k < fine; ++k) w += 1.0 / fine * rate(w + 0.5 / fine * rate(w));
      const double pressure = SlowBubblyEos(g, 0.001, w).pressure(rho);
      EXPECT_NEAR(found.dissolved - 0.001, w - 0.001, 0.02 * (0.001 - w)) << tau << ' ' << modulus;
      EXPECT_NEAR(found.pressure, pressure, 0.002 * pressure) << tau << ' ' << modulus;
    }
}

// However short tau is against the step: equilibrium, without swinging about it.
TEST(Exsolution, ComesToRest) {
  for (const double tau : {0.05, 1e-3, 1e-9}) {
    const Sealed found = after(tau, 1e10, 300);
    if (found.dissolved == 0) continue;
    Group g = magma(1);
    g.eos.bulk_modulus = 1e10;
    g.bubbly.solubility_pressure = 2e9;
    const double pressure = bubbly_eos(g, 0.001).pressure(2500 * (1 + 1e6 / 1e10));
    EXPECT_NEAR(found.pressure, pressure, 1e-6 * pressure) << tau;
  }
}

}  // namespace
