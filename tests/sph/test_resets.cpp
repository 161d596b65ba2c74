// Boxes that renew what comes into them: what they set, what they keep, and that budgets know of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sph/laws/enthalpy.hpp"
#include "sph/laws/eos/bubbly.hpp"
#include "sph/output/monitors.hpp"
#include "sph/step/simulation.hpp"

namespace {

using sph::Field;
using sph::Simulation;

const decomp::Comm& world() {
  static const decomp::Comm comm(MPI_COMM_WORLD);
  return comm;
}

std::string scene(const std::string& more) {
  return "[domain]\nlower = [0, 0]\nupper = [24, 12]\nperiodic = [true, true]\nsurface_pressure = "
         "1e6\n[kernel]\n"
         "h_over_dx = 1.0\n[[group]]\nname = \"magma\"\nkind = \"fluid\"\neos = \"bubbly\"\ndensity = "
         "2500\nsound_speed = 100\ngas_content = 0.002\ngas_rt = 5e5\nsolubility_pressure = 1e9\ntemperature "
         "= 1200\n"
         "heat = { specific_heat = 1000, latent_heat = 3e5, solidus = 1000, liquidus = 1300 "
         "}\n[start]\nspacing = 1\n"
         "[[start.region]]\ngroup = \"magma\"\n[time]\nsteps = 9\n[[monitor]]\nkind = \"budget\"\n" +
         more;
}

const std::string box =
    "[[reset]]\nlower = [4, 0]\nupper = [8, 12]\ntemperature = 1400\ngas_content = 0.003\n";

double column(Simulation& s, const std::string& name) {
  const sph::Monitors monitors(s);
  const std::vector<double> row = monitors.values(s);
  const auto at = std::ranges::find(monitors.names(), "budget_" + name);
  return row.at(static_cast<std::size_t>(at - monitors.names().begin()));
}

// Without pressure of its own nothing moves: what is in the box is another matter at the same pressure.
TEST(Resets, KeepPressureAndCountWhatTheyAdd) {
  Simulation s(world(), sph::parse_scene(scene(box), "scene", {}));
  const double mass = column(s, "mass"), heat = column(s, "heat"), gas = column(s, "gas");
  s.step();
  const sph::Particles& p = s.particles();
  const sph::Group& g = s.scene().groups[0];
  const double before = bubbly_eos(g, 0.002).density(1e6), after = bubbly_eos(g, 0.003).density(1e6);
  for (std::size_t i = 0; i < p.owned(); ++i) {
    const double x = s.scale().metres(p.data<Field::position>()[2 * i]);
    const bool inside = x >= 4 && x < 8;
    EXPECT_EQ(p.data<Field::gas_content>()[i], inside ? 0.003 : 0.002);
    EXPECT_NEAR(p.data<Field::temperature>()[i], inside ? 1400 : 1200, 1e-9);
    EXPECT_NEAR(p.data<Field::enthalpy>()[i], enthalpy(g.heat.material, inside ? 1400 : 1200), 1e-6);
    EXPECT_NEAR(p.data<Field::density>()[i], inside ? after : before, 1e-9 * before);
    EXPECT_NEAR(p.data<Field::mass>()[i], before * (inside ? 1.003 / 1.002 : 1), 1e-12 * before);
    EXPECT_NEAR(p.data<Field::pressure>()[i], 0, 1e-4);
  }
  const double liquid = before / 1.002, renewed = 48, m = 1.003 * liquid;
  EXPECT_NEAR(column(s, "gas_in"), renewed * 0.001 * liquid, 1e-9);
  EXPECT_NEAR(column(s, "heat_in"), renewed * (m * (1.4e6 + 3e5) - before * (1.2e6 + 2e5)), 1e-3);
  EXPECT_NEAR(column(s, "mass") - column(s, "gas_in"), mass, 1e-13 * mass);
  EXPECT_NEAR(column(s, "gas") - column(s, "gas_in"), gas, 1e-13 * gas);
  EXPECT_NEAR(column(s, "heat") - column(s, "heat_in"), heat, 1e-13 * heat);
}

// In motion along the period, with flow of gas and conduction: all that comes out of the box has been in it.
TEST(Resets, RenewWhatFlowsThrough) {
  Simulation s(world(),
               sph::parse_scene(scene(box), "scene",
                                {"start.velocity=[20, 0]", "group.magma.permeability={coefficient=1e-10}",
                                 "group.magma.heat.conductivity=1e3", "time.until=1"}));
  const double mass = column(s, "mass"), heat = column(s, "heat"), gas = column(s, "gas");
  while (s.global().time < 1) {
    s.step();
    EXPECT_NEAR(column(s, "mass") - column(s, "gas_in"), mass, 1e-13 * mass);
    EXPECT_NEAR(column(s, "gas") - column(s, "gas_in"), gas, 1e-13 * gas);
    EXPECT_NEAR(column(s, "heat") - column(s, "heat_in"), heat, 1e-13 * heat);
  }
  const sph::Particles& p = s.particles();
  for (std::size_t i = 0; i < p.owned(); ++i) {
    const double x = s.scale().metres(p.data<Field::position>()[2 * i]);
    EXPECT_GT(p.data<Field::temperature>()[i], x > 8 && x < 22 ? 1390 : 1000) << x;
  }
}

// At constant volume a pressure is mass: gas and liquid as they are there, with their heat.
TEST(Resets, CountTheMassThatPressureBrings) {
  Simulation s(world(),
               sph::parse_scene(scene("[[reset]]\nlower = [4, 0]\nupper = [8, 12]\npressure = 1e5\n"),
                                "scene", {"group.magma.permeability={coefficient=1e-10}"}));
  const double mass = column(s, "mass"), heat = column(s, "heat"), gas = column(s, "gas");
  const sph::Group& g = s.scene().groups[0];
  const double more = bubbly_eos(g, 0.002).density(1.1e6) - bubbly_eos(g, 0.002).density(1e6);
  for (int k = 0; k < 30; ++k) {
    s.step();
    if (k == 0) {
      EXPECT_NEAR(column(s, "mass_added"), 48 * more / 1.002, 1e-6 * more);
    }
    EXPECT_NEAR(column(s, "mass") - column(s, "mass_added") - column(s, "gas_in"), mass, 1e-13 * mass);
    EXPECT_NEAR(column(s, "gas") - column(s, "gas_in"), gas, 1e-13 * gas);
    EXPECT_NEAR(column(s, "heat") - column(s, "heat_in"), heat, 1e-13 * heat);
  }
}

// A pump: as much as its rate says, whatever passes through its box, with the heat and the gas of what is there.
TEST(Resets, LetFlowInWhatTheySay) {
  const std::string pump =
      "[[reset]]\nlower = [4, 0]\nupper = [8, 6]\ninflow = [[0, 100], [0.2, 500], [0.4, 300]]\nuntil = 0.5\n";
  Simulation s(world(), sph::parse_scene(scene(pump), "scene",
                                         {"start.velocity=[20, 0]", "start.jitter=0.2", "time.until=1"}));
  const double mass = column(s, "mass"), heat = column(s, "heat"), gas = column(s, "gas");
  const auto brought = [](double t) {
    if (t < 0.2) return 100 * t + 1000 * t * t;
    if (t < 0.4) return 60 + 500 * (t - 0.2) - 500 * (t - 0.2) * (t - 0.2);
    return 140 + 300 * (t - 0.4);
  };
  EXPECT_EQ(s.global().inflows.at(0).receivers, 24);
  bool changes = false;
  while (s.global().time < 1) {
    const std::int64_t before = s.global().inflows[0].receivers;
    s.step();
    changes = changes || s.global().inflows[0].receivers != before;
    EXPECT_NEAR(column(s, "mass") - column(s, "mass_added") - column(s, "gas_in"), mass, 1e-13 * mass);
    EXPECT_NEAR(column(s, "gas") - column(s, "gas_in"), gas, 1e-13 * gas);
    EXPECT_NEAR(column(s, "heat") - column(s, "heat_in"), heat, 1e-13 * heat);
    const double t = std::min(s.global().time, 0.5), since = column(s, "mass") - mass;
    // By the midpoint rule, but for what the last change of their number has left over and a step at the end.
    EXPECT_NEAR(since + s.global().inflows[0].due, brought(t),
                0.02 + 300 * s.global().dt * (t == 0.5 ? 1 : 0));
    EXPECT_LT(std::abs(s.global().inflows[0].due), 500 * s.global().dt);
  }
  EXPECT_TRUE(changes) << "no test: the same number was in the box all the time";
}

// A lattice that passes a narrow box: now two rows are in it, now one.
TEST(Resets, TakeNothingOutWhereMoreCameThanWasTo) {
  const std::string pump = "[[reset]]\nlower = [4, 0]\nupper = [5.5, 12]\ninflow = 2000\nuntil = 0.3\n";
  Simulation s(world(), sph::parse_scene(scene(pump), "scene", {"start.velocity=[20, 0]", "time.until=1"}));
  const double start = column(s, "mass");
  double mass = start, most = 0;
  while (s.global().time < 1) {
    s.step();
    const double now = column(s, "mass");
    EXPECT_GE(now - mass, -1e-9 * mass);
    most = std::max(most, s.global().inflows[0].due / (2000 * s.global().dt));
    mass = now;
  }
  EXPECT_LT(most, 1.01);
  EXPECT_NEAR(mass - start + s.global().inflows[0].due, 2000 * 0.3, 1e-9 * mass);
  EXPECT_LE(s.global().inflows[0].due, 0) << "what was to come has";
  EXPECT_GT(s.global().inflows[0].due, -2 * 2000 * s.global().dt);
}

TEST(Resets, NeedNoFluidWhereNothingFlowsIn) {
  const std::string pump =
      "[[reset]]\nlower = [4, 0]\nupper = [4.7, 0.9]\ninflow = [[0, 10], [0.05, 10], [0.06, 0]]\n";
  Simulation s(world(), sph::parse_scene(scene(pump), "scene", {"start.velocity=[2, 0]", "time.until=0.2"}));
  const double start = column(s, "mass");
  while (s.global().time < 0.2) s.step();
  EXPECT_GT(column(s, "mass"), start);
}

std::string complaint(const std::string& reset, const std::vector<std::string>& settings) {
  try {
    Simulation s(world(), sph::parse_scene(scene(reset), "scene", settings));
    while (s.global().time < 1) s.step();
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

TEST(Resets, StopWhereNothingIsThereToReceive) {
  const std::string pump = "[[reset]]\ninflow = 1\nlower = [4, 0]\n";
  EXPECT_NE(complaint(pump + "upper = [4.4, 0.9]\n", {})
                .find("scene: reset.0.inflow: no fluid is in the box at the start"),
            std::string::npos);
  const std::string later =
      complaint(pump + "upper = [4.7, 0.9]\n", {"start.velocity=[20, 0]", "time.until=1"});
  EXPECT_NE(later.find("no fluid is in the box of reset.0, into which"), std::string::npos) << later;
}

TEST(Resets, AreOfTheirOwnMatter) {
  // Fluid without gas, a solid: the temperature alone; the last box counts.
  const std::string more =
      "[[group]]\nname = \"rock\"\nkind = \"solid\"\ndensity = 2700\nsound_speed = 100\npoisson_ratio = "
      "0.25\n"
      "temperature = 900\nheat = { specific_heat = 1200 }\n" +
      box + "[[reset]]\nlower = [6, 0]\nupper = [9, 12]\ntemperature = 700\n";
  Simulation s(world(),
               sph::parse_scene(scene(more), "scene",
                                {"start.region.0.group=rock", "terms.motion=false", "time.dt=1e-3"}));
  s.step();
  const sph::Particles& p = s.particles();
  for (std::size_t i = 0; i < p.owned(); ++i) {
    const double x = s.scale().metres(p.data<Field::position>()[2 * i]);
    EXPECT_NEAR(p.data<Field::temperature>()[i], x < 4 || x > 9 ? 900 : x < 6 ? 1400 : 700, 1e-9);
    EXPECT_NEAR(p.data<Field::mass>()[i], 2700 * (1 + 1e6 / 2.7e7), 1e-6);
  }
  EXPECT_EQ(column(s, "gas_in"), 0);
}

}  // namespace
