// Melts on a grid: what is conserved, what stays at rest, steps far beyond where an interface would slosh.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "decomp/exact_sum.hpp"
#include "sph/core/error.hpp"
#include "sph/output/monitors.hpp"
#include "sph/step/simulation.hpp"

namespace sph {
namespace {

#define EXPECT_SAYS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

const std::string tests_dir = PEPERITE_TEST_DIR;

const decomp::Comm& world() {
  static const decomp::Comm comm(MPI_COMM_WORLD);
  return comm;
}

/// What a GuardError says that `work` ends with.
template <class Work>
std::string guard_text(Work&& work) {
  try {
    work();
  } catch (const GuardError& error) {
    return error.what();
  }
  return "(nothing)";
}

Scene melts(const std::string& file, const std::vector<std::string>& overrides = {}) {
  return read_scene(tests_dir + "/scenes/" + file, overrides);
}

/// Sums over all cells and ranks of what `value` says of a row.
template <class Value>
double sum_of(const Simulation& s, Value value) {
  decomp::ExactSum sum;
  const Particles& p = s.particles();
  for (std::size_t i = 0; i < p.owned(); ++i) sum.add(value(p, i));
  decomp::ExactSum::all_reduce(s.comm(), std::span(&sum, 1));
  return sum.value();
}

double second_melt(const Simulation& s) {
  return sum_of(s, [](const Particles& p, std::size_t i) {
    return p.data<Field::composition>()[i] * p.data<Field::melt_share>()[i];
  });
}
double mean_square_speed(const Simulation& s) {
  const double square = sum_of(s, [](const Particles& p, std::size_t i) {
    const auto d = static_cast<std::size_t>(p.dim());
    double v2 = 0;
    for (std::size_t a = 0; a < d; ++a)
      v2 += p.data<Field::velocity>()[i * d + a] * p.data<Field::velocity>()[i * d + a];
    return v2;
  });
  return square / static_cast<double>(s.particle_count());
}

TEST(Melt, NoneIsLostAndNoneIsMade) {
  for (const char* file : {"melts2d.toml", "melts3d.toml"}) {
    Simulation s(world(), melts(file));
    const double before = second_melt(s);
    for (int k = 0; k < 8; ++k) s.step();
    EXPECT_GT(mean_square_speed(s), 0) << file;
    EXPECT_NEAR(second_melt(s), before, 1e-13 * before) << file;
    const Particles& p = s.particles();
    for (std::size_t i = 0; i < p.owned(); ++i) {
      EXPECT_GE(p.data<Field::composition>()[i], -1e-12);
      EXPECT_LE(p.data<Field::composition>()[i], 1 + 1e-12);
      EXPECT_NEAR(p.data<Field::melt_share>()[i], 1, 1e-2);
    }
  }
}

constexpr const char* warm_below = R"(
[domain]
lower = [0, 0]
upper = [1, 1]
gravity = [0, -10]
[melt]
cells = [16, 16]
diffusivity = 1e-3
expansion = 1e-3
wave_height = 0.2
wave_length = 2
[[group]]
name = "cold"
kind = "melt"
density = 2000
viscosity = 50
temperature = 1
[[group]]
name = "warm"
kind = "melt"
density = 2000
viscosity = 20
temperature = 9
[start]
[[start.region]]
group = "cold"
[[start.region]]
group = "warm"
shape = "box"
lower = [0, 0]
upper = [1, 0.5]
[time]
steps = 20
dt = 1
)";

// Volumes of cells are 1 within the tolerance alone; heat is that of the volumes.
TEST(Melt, HeatStaysBetweenInsulatedSides) {
  for (const char* tolerance : {"melt.tolerance=1e-4", "melt.tolerance=0.1"}) {
    Simulation s(world(), parse_scene(warm_below, "heat", {tolerance}));
    const auto heat = [&] {
      return sum_of(s, [](const Particles& p, std::size_t i) {
        return p.data<Field::temperature>()[i] * p.data<Field::melt_share>()[i];
      });
    };
    const double before = heat();
    for (int k = 0; k < 20; ++k) s.step();
    EXPECT_GT(mean_square_speed(s), 0);
    EXPECT_NEAR(heat(), before, 1e-13 * before) << tolerance;
  }
}

TEST(Melt, AUniformTemperatureStaysSoToTheBit) {
  Simulation s(world(), parse_scene(warm_below, "uniform",
                                    {"melt.tolerance=0.1", "group.cold.temperature=0.5",
                                     "group.warm.temperature=0.5", "group.cold.density=2600"}));
  for (int k = 0; k < 10; ++k) s.step();
  EXPECT_GT(mean_square_speed(s), 0);
  const Particles& p = s.particles();
  for (std::size_t i = 0; i < p.owned(); ++i) EXPECT_EQ(p.data<Field::temperature>()[i], 0.5);
}

constexpr const char* layers = R"(
[domain]
lower = [0, 0]
upper = [1, 1]
gravity = [0, -1]
[melt]
cells = [32, 32]
tolerance = 1e-6
wave_height = 0
[[melt.side]]
side = "y0"
slip = false
[[group]]
name = "light"
kind = "melt"
density = 1
viscosity = 1
[[group]]
name = "heavy"
kind = "melt"
density = 2
viscosity = 1
[start]
[[start.region]]
group = "light"
[[start.region]]
group = "heavy"
shape = "box"
lower = [0, -1]
upper = [1, 0.53]
[time]
steps = 5
dt = 50
)";

TEST(Melt, FlatLayersStayAtRest) {
  Simulation s(world(), parse_scene(layers, "layers", {}));
  for (int k = 0; k < 3; ++k) s.step();
  EXPECT_EQ(mean_square_speed(s), 0);
}

// What is left of a flow that comes to rest is rounding: no tolerance is a share of that.
TEST(Melt, WhatComesToRestIsNoFault) {
  Simulation s(world(),
               parse_scene(layers, "layers",
                           {"melt.wave_height=0.001", "melt.wave_length=2", "melt.diffusivity=0.01",
                            "melt.expansion=1e-3", "group.heavy.density=1", "group.heavy.temperature=5",
                            "group.light.temperature=5.1", "time.dt=50"}));
  for (int k = 0; k < 60; ++k) s.step();
  EXPECT_LT(mean_square_speed(s), 1e-20);
}

// A wave of length 2 of a stable interface slackens at drho g lambda / (16 pi eta) or less: an explicit step beyond twice
// its inverse would throw it over. At twenty times that it comes to rest without turning once.
TEST(Melt, AStableInterfaceDoesNotSloshHoweverLongTheStep) {
  const double limit = 16 * std::numbers::pi / 2;
  Simulation s(world(), parse_scene(layers, "layers",
                                    {"melt.wave_height=0.02", "melt.wave_length=2", "melt.courant=0.5",
                                     "time.dt=" + std::to_string(20 * limit)}));
  // First moment of the heavy melt along x, weighted by the wave: its amplitude.
  const auto amplitude = [&] {
    return sum_of(s, [&](const Particles& p, std::size_t i) {
      const double x = s.scale().metres(p.data<Field::position>()[2 * i]);
      return p.data<Field::composition>()[i] * std::cos(std::numbers::pi * x);
    });
  };
  double before = amplitude();
  EXPECT_GT(before, 1);
  const double first = before;
  for (int k = 0; k < 12; ++k) {
    s.step();
    const double now = amplitude();
    EXPECT_LE(now, before + 1e-6 * first);
    EXPECT_GE(now, -0.02 * first);
    before = now;
  }
  EXPECT_LT(before, 0.1 * first);
}

// Cells need not be square, whatever repeats.
TEST(Melt, PeriodsHoldCellsOfAnyWidth) {
  const Scene scene = melts("melts3d.toml", {"domain.upper=[1.1, 1.25, 1]"});
  EXPECT_TRUE(scene.domain.periodic[0]);
  Simulation s(world(), scene);
  s.step();
  EXPECT_GT(mean_square_speed(s), 0);
  const Scene again = parse_scene(to_toml(scene), "again", {});
  EXPECT_EQ(to_toml(again), to_toml(scene));
}

// What is resolved of a scene without heat can be read again, as a run that is resumed does.
TEST(Melt, AResolvedSceneWithoutHeatCanBeRead) {
  const Scene scene = parse_scene(layers, "layers", {});
  const Scene again = parse_scene(to_toml(scene), "again", {});
  EXPECT_EQ(to_toml(again), to_toml(scene));
}

TEST(Melt, AFlowThatIsNotFoundEndsTheRun) {
  Simulation s(world(), melts("melts2d.toml", {"melt.most_iterations=2"}));
  const std::string text = guard_text([&] { s.step(); });
  EXPECT_SAYS(text, "step 0: the slow flow has a residual of");
  EXPECT_SAYS(text, "raise melt.most_iterations or melt.tolerance");
}

TEST(Melt, NothingFlowsAndThereIsNoStep) {
  Simulation s(world(), parse_scene(layers, "layers", {"time.dt=", "group.heavy.density=1"}));
  EXPECT_SAYS(guard_text([&] { s.step(); }), "nothing flows, and there is no time.dt: give one");
}

std::string box(const std::string& domain, const std::string& melt, const std::string& more) {
  return "[domain]\nlower = [0, 0]\nupper = [1, 1]\n" + domain + "[melt]\ntolerance = 1e-8\n" + melt +
         "[[group]]\nname = \"m\"\nkind = \"melt\"\ndensity = 1000\nviscosity = 100\n[start]\n"
         "[[start.region]]\ngroup = \"m\"\n" +
         more;
}

// Poiseuille's: f H^2 / (12 eta) in the mean, sqrt(6/5) times that in v_rms; f is the weight of the melt.
TEST(Melt, AForceAlongAPeriodDrivesAFlow) {
  Simulation s(world(), parse_scene(box("periodic = [true, false]\ngravity = [1, 0]\n",
                                        "cells = [32, 32]\nside = [{ side = \"y0\", slip = false }, { side = "
                                        "\"y1\", slip = false }]\n",
                                        "[time]\nsteps = 1\ndt = 1e-3\n"),
                                    "channel", {}));
  s.step();
  EXPECT_NEAR(std::sqrt(mean_square_speed(s)), 1000.0 / 1200 * std::sqrt(1.2), 5e-3);
}

/// Melts of 1000 kg/m^3 below lighter ones, which a wave has displaced; no time.dt.
Scene settling(const std::string& heavier, const std::string& tolerance) {
  return parse_scene(box("gravity = [0, -10]\n", "cells = [12, 12]\nwave_height = 0.2\nwave_length = 2\n",
                         "[[group]]\nname = \"light\"\nkind = \"melt\"\ndensity = 1000\nviscosity = 100\n"
                         "[time]\nsteps = 1000\n"),
                     "settling",
                     {"melt.mixture=linear", "group.m.density=" + heavier, "melt.tolerance=" + tolerance});
}

// What the solver leaves of a flow at rest would carry melts away in steps of 1e11 s, the time in which it passes a cell.
TEST(Melt, WhatHasSettledStaysWithoutAStepGiven) {
  for (const char* tolerance : {"0.01", "1e-4"}) {
    Simulation s(world(), settling("1100", tolerance));
    double speed = 1;
    for (int k = 0; k < 200; ++k) {
      s.step();
      const double now = std::sqrt(mean_square_speed(s));
      EXPECT_LE(now, 1.05 * speed) << tolerance << ' ' << k;
      speed = now;
    }
    EXPECT_LT(speed, 2e-5);
  }
}

// Differences of density that are lost in the rounding of the weight bound no step.
TEST(Melt, WhatIsAsHeavyIsNotCarriedAwayWithoutAWord) {
  Simulation s(world(), settling("1000.000000001", "1e-4"));
  const std::string text = guard_text([&] {
    for (int k = 0; k < 1000; ++k) s.step();
  });
  EXPECT_SAYS(text, "leaves of a flow at rest carries it away; give time.dt");
}

TEST(Melt, MonitorsSayWhatFlowsAndWhatComesIn) {
  Simulation s(world(), melts("melts2d.toml"));
  const Monitors monitors(s);
  const std::vector<std::string> names{"melt_iterations",  "melt_residual", "melt_v_rms",  "melt_temperature",
                                       "melt_composition", "melt_heat_y0",  "melt_heat_y1"};
  EXPECT_EQ(monitors.names(), names);
  s.step();
  const std::vector<double> values = monitors.values(s);
  ASSERT_EQ(values.size(), names.size());
  EXPECT_GT(values[0], 3);
  EXPECT_LE(values[1], 1e-3);
  EXPECT_NEAR(values[2], std::sqrt(mean_square_speed(s)), 1e-12 * values[2]);
  EXPECT_GT(values[5], 0);
  EXPECT_EQ(values[6], -1e-3);
}

}  // namespace
}  // namespace sph
