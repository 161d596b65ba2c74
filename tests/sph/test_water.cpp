// Water that diffuses in magma: what each particle has and all have together, at rest and moving, and the step that it bears.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sph/output/monitors.hpp"
#include "sph/step/simulation.hpp"

namespace {

using sph::Field;
using sph::Simulation;

const decomp::Comm& world() {
  static const decomp::Comm comm(MPI_COMM_WORLD);
  return comm;
}

std::string magma(const std::string& name, const std::string& more) {
  return "[[group]]\nname = \"" + name +
         "\"\nkind = \"fluid\"\neos = \"bubbly\"\ndensity = 2400\nsound_speed = 100\ngas_rt = 5e5\n"
         "solubility_pressure = 1e9\nsolubility_exponent = 1\n" +
         more + "\n";
}

/// A periodic box of 16 by 16 spacings at 10 bar with a ball of other magma.
std::string box(const std::string& inside, const std::string& outside, const std::string& more) {
  return "kernel = { h_over_dx = 1 }\n[domain]\nlower = [0, 0]\nupper = [16, 16]\nperiodic = [true, true]\n"
         "surface_pressure = 1e6\n" +
         magma("outside", outside) + magma("inside", inside) +
         "[start]\nspacing = 1\njitter = 0.1\nregion = [{ group = \"outside\" }, { group = \"inside\", "
         "shape = \"ball\", centre = [8, 8], radius = 4 }]\n[time]\nsteps = 1\n[[monitor]]\nkind = "
         "\"budget\"\n" +
         more;
}

struct Range {
  double lowest, highest;
};
template <class Of>
Range range(const Simulation& s, const std::string& group, Of of) {
  double ends[2]{-1e300, -1e300};
  const sph::Particles& p = s.particles();
  for (std::size_t i = 0; i < p.owned(); ++i) {
    if (!group.empty() && s.scene().groups[p.data<Field::group>()[i]].name != group) continue;
    const double value = of(p.data<Field::gas_content>()[i], p.data<Field::dissolved_gas>()[i]);
    EXPECT_TRUE(std::isfinite(value));
    ends[0] = std::max(ends[0], -value);
    ends[1] = std::max(ends[1], value);
  }
  s.comm().max(ends);
  return {-ends[0], ends[1]};
}
double dissolved(double, double w) { return w; }
double all(double m, double) { return m; }
double bubbles(double m, double w) { return m - w; }

const std::string still = "[terms]\nmotion = false\n";

// Undersaturated magma beside some with bubbles: w stays between what it was, bubbles keep what they have.
TEST(Water, SpreadsInWhatIsDissolved) {
  const std::string spreads = "exsolution_time = 1e30\nwater_diffusivity = 1e-3\n";
  Simulation s(world(), sph::parse_scene(
                            box("gas_content = 0.01\n" + spreads, "gas_content = 2e-4\n" + spreads, still),
                            "spreads", {}));
  const sph::Monitors monitors(s);
  const std::vector<double> first = monitors.values(s);
  const Range before = range(s, "", dissolved), foam = range(s, "inside", bubbles);
  EXPECT_NEAR(before.lowest, 2e-4, 1e-12);
  EXPECT_NEAR(before.highest, 1e-3, 1e-9);
  EXPECT_GT(foam.lowest, 8e-3);
  for (int k = 0; k < 400; ++k) s.step();
  const Range now = range(s, "", dissolved);
  EXPECT_GE(now.lowest, before.lowest);
  EXPECT_LE(now.highest, before.highest * (1 + 1e-14));
  EXPECT_LT(now.highest - now.lowest, 0.5 * (before.highest - before.lowest));
  const Range kept = range(s, "inside", bubbles);
  EXPECT_NEAR(kept.lowest, foam.lowest, 1e-15);
  EXPECT_NEAR(kept.highest, foam.highest, 1e-15);
  EXPECT_NEAR(monitors.values(s)[1] / first[1], 1, 1e-14);
}

// Where one of both has no diffusivity nothing passes; nor does anything into what is no magma.
TEST(Water, StaysWhereItDoesNotDiffuse) {
  const std::string slow = "exsolution_time = 1e12\n";
  Simulation s(world(), sph::parse_scene(box("gas_content = 0.01\n" + slow,
                                             "gas_content = 2e-4\nwater_diffusivity = 1e-3\n" + slow, still),
                                         "stays", {}));
  const Range inside = range(s, "inside", all), outside = range(s, "outside", all);
  for (int k = 0; k < 50; ++k) s.step();
  EXPECT_EQ(range(s, "inside", all).highest, inside.highest);
  EXPECT_EQ(range(s, "inside", all).lowest, inside.lowest);
  EXPECT_NEAR(range(s, "outside", all).highest, outside.highest, 1e-15);
}

// A vortex, bubbles that come and go, foam that fragments and heals, gas that flows, heat that follows: all is counted.
TEST(Water, IsAccountedForWhereAllMoves) {
  const auto hot = [](const std::string& temperature) {
    return "exsolution_time = 0.05\nwater_diffusivity = 0.5\npermeability = { coefficient = 1e-9 }\n"
           "temperature = " +
           temperature + "\nheat = { specific_heat = 1000, conductivity = 1e5 }\n";
  };
  const std::string flow =
      "[[monitor]]\nkind = \"momentum\"\nname = \"impulse\"\n"
      "[terms]\nviscous_heat = true\n";
  std::string scene = box("gas_content = 0.0022\nviscosity = 1000\nbecomes = [{ group = \"spray\", "
                          "void_fraction_above = 0.12 }]\n" +
                              hot("1400"),
                          "gas_content = 4e-4\nviscosity = 1000\n" + hot("1100"), flow) +
                      magma("spray",
                            "gas_content = 0.002\nviscosity = 100\nbecomes = [{ group = \"inside\", "
                            "void_fraction_below = 0.1 }]\n" +
                                hot("1400"));
  Simulation s(world(), sph::parse_scene(
                            scene, "moves",
                            {"start.velocity=taylor_green", "start.flow_length=16", "start.flow_speed=5"}));
  const sph::Monitors monitors(s);
  const std::vector<double> first = monitors.values(s);  // mass, heat, heat_in, gas, momentum
  const auto liquid = [](const std::vector<double>& v) { return v[0] - v[3]; };
  for (int k = 0; k < 3000; ++k) {
    s.step();
    if (k % 100 != 99) continue;
    const std::vector<double> now = monitors.values(s);
    EXPECT_NEAR(now[3] / first[3], 1, 1e-12);
    EXPECT_NEAR(liquid(now) / liquid(first), 1, 1e-12);
    EXPECT_NEAR((now[1] - now[2]) / first[1], 1, 1e-12);
    for (std::size_t a = 4; a < 6; ++a) EXPECT_NEAR(now[a], first[a], 1e-12 * 5 * first[0]);
    ASSERT_GT(range(s, "", dissolved).lowest, 0);
    ASSERT_GE(range(s, "", bubbles).lowest, -1e-15);
  }
  EXPECT_GT(range(s, "outside", all).highest, 6e-4);  // of 4e-4
}

std::string refusal(const std::string& text, const std::vector<std::string>& more) {
  try {
    Simulation(world(), sph::parse_scene(text, "scene", more));
  } catch (const sph::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Water, RefusesStepsThatAreTooLong) {
  const std::string spreads = "gas_content = 0.001\nexsolution_time = 1\nwater_diffusivity = 1e-2\n";
  const std::string text = box(spreads, spreads, still);
  EXPECT_EQ(refusal(text, {}), "");
  EXPECT_EQ(refusal(text, {"time.dt=15"}), "");
  EXPECT_EQ(refusal(text, {"time.dt=16"}),
            "scene: time.dt: 16 s is above the limit of water that diffuses, 15 s; set it to that or less, "
            "or reduce group.water_diffusivity");
  Simulation s(world(), sph::parse_scene(text, "scene", {}));
  EXPECT_EQ(s.global().dt, 15);
  s.step();
  EXPECT_EQ(s.global().dt, 15);
}

}  // namespace
