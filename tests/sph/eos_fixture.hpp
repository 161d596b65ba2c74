// What any barotropic equation of state must be: its functions belong to one p(rho).
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "sph/laws/eos/law.hpp"
#include "start/hydrostatic.hpp"

namespace sph::test {

/// A fluid of 3000 kg/m^3 and 50 GPa with the law's own constants.
inline Group fluid_of(const LawConstants& constants) {
  Group g;
  g.density = 3000;
  g.eos.bulk_modulus = 5e10;
  g.eos.constants = constants;
  return g;
}

/// From rho_0 times `least` to rho_0 times `most`: the inverse, c^2 = dp/drho, de/drho = p/rho^2, and at rest
/// no pressure, no energy and c^2 = K/rho_0.
template <class Eos>
void expect_one_law(const Group& g, double least, double most) {
  const double unit = g.eos.bulk_modulus / g.density;
  EXPECT_EQ(Eos::pressure(g, g.density), 0);
  EXPECT_EQ(Eos::energy(g, g.density), 0);
  EXPECT_NEAR(Eos::sound_speed(g, g.density) / std::sqrt(unit), 1, 1e-14);
  for (int k = 0; k <= 40; ++k) {
    const double rho = g.density * (least + (most - least) * k / 40), d = 1e-5 * rho;
    const double p = Eos::pressure(g, rho), c2 = Eos::sound_speed(g, rho) * Eos::sound_speed(g, rho);
    EXPECT_NEAR(Eos::density(g, p) / rho, 1, 1e-13) << rho;
    EXPECT_NEAR((Eos::pressure(g, rho + d) - Eos::pressure(g, rho - d)) / (2 * d) / c2, 1, 1e-7) << rho;
    EXPECT_NEAR((Eos::energy(g, rho + d) - Eos::energy(g, rho - d)) / (2 * d) * unit, p / (rho * rho),
                1e-7 * unit / rho)
        << rho;
  }
}

/// A scene of still rock with that law, `keys` being its own: read again, it is the same scene; and the
/// pressure grows by the weight of what it makes dense.
template <class Eos>
void expect_still_rock(const std::string& keys) {
  const std::string scene_text = R"(
domain = { lower = [0, -1e5], upper = [1e4, 0], gravity = [0, -9.8] }
kernel = { h_over_dx = 1.2 }
time = { steps = 1 }
[start]
spacing = 500
pressure = "hydrostatic"
layer = [{ group = "rock", top = 0 }]
region = [{ group = "rock" }]
[[group]]
name = "rock"
kind = "fluid"
density = 3000
bulk_modulus = "50 GPa"
)";
  const Scene scene =
      parse_scene(scene_text + "eos = \"" + std::string(Eos::word) + "\"\n" + keys, "rock", {});
  EXPECT_EQ(parse_scene(to_toml(scene), "rock", {}), scene);
  const HydrostaticColumn column(scene);
  for (double y = -100; y > -99e3; y -= 1300) {
    const double slope = (column({0, y - 50, 0}) - column({0, y + 50, 0})) / 100;
    EXPECT_NEAR(slope / (9.8 * Eos::density(scene.groups[0], column({0, y, 0}))), 1, 1e-6) << y;
  }
}

}  // namespace sph::test
