// Inlets, outlets and faces that delete: who comes and goes, under which names, and that budgets know of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "sph/output/monitors.hpp"
#include "sph/step/simulation.hpp"

namespace {

using sph::Field;
using sph::Simulation;

const decomp::Comm& self() {
  static const decomp::Comm comm(MPI_COMM_SELF);
  return comm;
}

/// A strip along x, periodic across, of warm magma with gas.
std::string strip(const std::string& more) {
  return "[domain]\nlower = [0, 0]\nupper = [26, 12]\nperiodic = [false, true]\nsurface_pressure = 1e6\n"
         "leaves = \"delete\"\n[kernel]\n"
         "h_over_dx = 1.0\n[[group]]\nname = \"magma\"\nkind = \"fluid\"\neos = \"bubbly\"\ndensity = "
         "2500\nsound_speed = 100\ngas_content = 0.002\ngas_rt = 5e5\nsolubility_pressure = 1e9\ntemperature "
         "= 1200\npermeability = { coefficient = 1e-10 }\n"
         "heat = { specific_heat = 1000, latent_heat = 3e5, solidus = 1000, liquidus = 1300, conductivity = "
         "1e3 "
         "}\n[start]\nspacing = 1\nlower = [1, 0]\nupper = [24, 12]\nvelocity = [20, 0]\n"
         "[[start.region]]\ngroup = \"magma\"\n[time]\nsteps = 9\n[[monitor]]\nkind = \"budget\"\n" +
         more;
}

const std::string inlet =
    "[[inlet]]\nlower = [1, 0]\nupper = [4, 12]\ndirection = \"+x\"\ngroup = \"magma\"\nvelocity = [[0, 20], "
    "[0.5, 30]]\n"
    "temperature = 1250\ngas_content = 0.003\n";
const std::string outlet =
    "[[outlet]]\nlower = [20, 0]\nupper = [24, 12]\ndirection = \"+x\"\npressure = \"1 kPa\"\n";

double column(Simulation& s, const std::string& name) {
  const sph::Monitors monitors(
      s, std::vector<std::optional<std::uint64_t>>(s.scene().output.monitors.size() - 1, 0));
  const std::vector<double> row = monitors.values(s);
  const auto at = std::ranges::find(monitors.names(), "budget_" + name);
  return row.at(static_cast<std::size_t>(at - monitors.names().begin()));
}

/// What is there less what came from outside stays what it was.
struct Balance {
  double mass, heat, gas;
};
Balance balance(Simulation& s) {
  return {column(s, "mass") - column(s, "mass_in") + column(s, "mass_out") - column(s, "gas_in") +
              column(s, "gas_in_through"),
          column(s, "heat") - column(s, "heat_through") - column(s, "heat_in") + column(s, "heat_in_through"),
          column(s, "gas") - column(s, "gas_through") - column(s, "gas_in") + column(s, "gas_in_through")};
}

std::set<std::uint64_t> ids(const Simulation& s) {
  const std::uint64_t* id = s.particles().data<Field::id>();
  return {id, id + s.particles().owned()};
}

TEST(Openings, WhatComesInIsAsTheInletSaysAndHasAnIdOfItsOwn) {
  Simulation s(self(), sph::parse_scene(strip(inlet + outlet), "scene", {}));
  EXPECT_EQ(s.particle_count(), 23 * 12);
  const std::set<std::uint64_t> first = ids(s);
  const std::uint64_t stride = s.global().throughput.id_stride;
  EXPECT_GT(stride, *first.rbegin());
  const Balance before = balance(s);
  while (s.global().time < 0.5) {
    const double time = s.global().time + s.global().dt;
    s.step();
    const sph::Particles& p = s.particles();
    for (std::size_t i = 0; i < p.owned(); ++i) {
      const double x = s.scale().metres(p.data<Field::position>()[2 * i]);
      const std::uint32_t buffer = p.data<Field::buffer>()[i];
      EXPECT_TRUE(buffer != 1 || (x >= 1 - 1e-9 && x < 4)) << x;
      EXPECT_TRUE(buffer == 1 || x >= 4 - 1e-9) << x;
      EXPECT_TRUE(buffer == 2 || x < 20) << x;
      EXPECT_LT(x, 24);
      if (buffer != 1) continue;
      EXPECT_NEAR(p.data<Field::velocity>()[2 * i], 20 + 20 * std::fmin(time, 0.5), 1e-12);
      EXPECT_EQ(p.data<Field::velocity>()[2 * i + 1], 0);
      EXPECT_NEAR(p.data<Field::temperature>()[i], 1250, 1e-9);
      EXPECT_EQ(p.data<Field::gas_content>()[i], 0.003);
      EXPECT_NEAR(p.data<Field::mass>()[i], p.data<Field::density>()[i], 1e-9);
    }
  }
  const double in = column(s, "n_in"), out = column(s, "n_out");
  EXPECT_EQ(in, 13 * 12);  // 20 t + 10 t^2 = 12.5 spacings, the first layer has half of one to go
  EXPECT_GT(out, 0);
  EXPECT_EQ(s.particle_count(), 23 * 12 + static_cast<std::int64_t>(in - out));
  const std::set<std::uint64_t> now = ids(s);
  EXPECT_EQ(static_cast<std::int64_t>(now.size()), s.particle_count());
  for (const std::uint64_t id : now) EXPECT_TRUE(first.contains(id % stride));
  const Balance after = balance(s);
  EXPECT_NEAR(after.mass, before.mass, 1e-12 * before.mass);
  EXPECT_NEAR(after.heat, before.heat, 1e-12 * before.heat);
  EXPECT_NEAR(after.gas, before.gas, 1e-12 * before.gas);
}

// Beside nothing else: all that was there leaves, in the step in which it passes the face, and the run goes on.
TEST(Openings, FacesDeleteWhatLeaves) {
  Simulation s(self(),
               sph::parse_scene(strip("[[monitor]]\nkind = \"particle\"\nnearest_to = [20, 6]\n"), "scene",
                                {"group.magma.permeability=", "group.magma.heat=", "group.magma.temperature=",
                                 "group.magma.eos=linear", "group.magma.gas_content=", "group.magma.gas_rt=",
                                 "group.magma.solubility_pressure=", "domain.surface_pressure=0"}));
  const double mass = column(s, "mass");
  const std::vector<std::uint64_t> seen = sph::Monitors(s).ids();
  bool gone = false;
  while (s.global().time < 2) {
    s.step();
    const sph::Particles& p = s.particles();
    for (std::size_t i = 0; i < p.owned(); ++i) {
      EXPECT_LT(s.scale().metres(p.data<Field::position>()[2 * i]), 26);
      EXPECT_GE(s.scale().metres(p.data<Field::position>()[2 * i]), 0);
    }
    const std::vector<double> row = sph::Monitors(s, {seen.begin(), seen.end()}).values(s);
    EXPECT_EQ(std::isnan(row.back()), !ids(s).contains(seen.front()));
    gone = gone || std::isnan(row.back());
  }
  EXPECT_TRUE(gone);
  EXPECT_EQ(s.particle_count(), 0);
  EXPECT_EQ(column(s, "mass"), 0);
  EXPECT_NEAR(column(s, "mass_out"), mass, 1e-12 * mass);
  EXPECT_EQ(column(s, "n_out"), 23 * 12);
}

TEST(Openings, OtherFacesEndTheRun) {
  Simulation s(self(), sph::parse_scene(strip(""), "scene", {"domain.leaves=[\"x0\"]"}));
  EXPECT_THROW(
      {
        while (s.global().time < 2) s.step();
      },
      sph::GuardError);
  EXPECT_GT(s.particle_count(), 0);
}

// Of a body nothing can be taken away.
TEST(Openings, BodiesThatLeaveEndTheRun) {
  for (const char* body :
       {"rigid = true", "lagrangian = \"total\"\nsound_speed = 100\npoisson_ratio = 0.25"}) {
    Simulation s(self(), sph::parse_scene(
                             std::string("[domain]\nlower = [0, 0]\nupper = [30, 20]\nleaves = "
                                         "\"delete\"\n[kernel]\nh_over_dx = 1\n"
                                         "[[group]]\nname = \"water\"\nkind = \"fluid\"\ndensity = "
                                         "1000\nsound_speed = 100\n[[group]]\nname = \"ball\"\nkind = "
                                         "\"solid\"\ndensity = 1000\n") +
                                 body +
                                 "\n[start]\nspacing = 1\nlower = [8, 6]\nupper = [28, 14]\nvelocity = "
                                 "[10, 0]\n[[start.region]]\ngroup = \"water\"\n[[start.region]]\ngroup = "
                                 "\"ball\"\nshape = \"ball\"\ncentre = [24, 10]\nradius = 3\n[time]\n"
                                 "until = 1\n",
                             "body.toml", {}));
    EXPECT_THROW(
        {
          while (s.global().time < 1) s.step();
        },
        sph::GuardError)
        << body;
    EXPECT_GT(s.global().throughput.passages.back().count, 0) << "the water before it left";
  }
}

TEST(Openings, BoxesDeleteWhatComesIn) {
  Simulation s(self(),
               sph::parse_scene(strip("[[outlet]]\nlower = [10, 3]\nupper = [12, 9]\n"), "scene", {}));
  const Balance before = balance(s);
  while (s.global().time < 0.2) {
    s.step();
    const sph::Particles& p = s.particles();
    for (std::size_t i = 0; i < p.owned(); ++i) {
      const double x = s.scale().metres(p.data<Field::position>()[2 * i]),
                   y = s.scale().metres(s.wrap()(1, p.data<Field::position>()[2 * i + 1]));
      EXPECT_FALSE(x >= 10 && x < 12 && y >= 3 && y < 9);
    }
  }
  EXPECT_GT(column(s, "n_out"), 20);
  const Balance after = balance(s);
  EXPECT_NEAR(after.mass, before.mass, 1e-12 * before.mass);
  EXPECT_NEAR(after.heat, before.heat, 1e-12 * before.heat);
  EXPECT_NEAR(after.gas, before.gas, 1e-12 * before.gas);
}

// What an inlet leads is not yet of the budgets: nothing may be added to it there, nor what is renewed be counted as
// the difference of large masses, whose rounding adds up.
TEST(Openings, ResetsOverAnInletAreNotCounted) {
  const std::string reset = "[[reset]]\nlower = [0, 0]\nupper = [8, 12]\npressure = \"20 kPa\"\n";
  Simulation s(self(), sph::parse_scene(strip(inlet + outlet + reset), "scene", {}));
  const Balance before = balance(s);
  for (int k = 0; k < 1500; ++k) s.step();
  EXPECT_GT(column(s, "n_in"), 100);
  const Balance after = balance(s);
  EXPECT_NEAR(after.heat, before.heat, 1e-13 * before.heat);
  EXPECT_NEAR(after.gas, before.gas, 1e-13 * before.gas);
}

// Only fluid is led.
TEST(Openings, OutletsWithAPressureDeleteSolids) {
  Simulation s(
      self(),
      sph::parse_scene("[domain]\nlower = [0, 0]\nupper = [30, 20]\n[kernel]\nh_over_dx = 1\n"
                       "[[group]]\nname = \"rock\"\nkind = \"solid\"\ndensity = 2500\nsound_speed = 100\n"
                       "poisson_ratio = 0.25\n[[outlet]]\nlower = [20, 0]\nupper = [26, 20]\npressure = 0\n"
                       "direction = \"+x\"\n[start]\nspacing = 1\nlower = [14, 8]\nupper = [19, 12]\n"
                       "velocity = [20, 0]\n[[start.region]]\ngroup = \"rock\"\n[time]\nuntil = 1\n"
                       "[[monitor]]\nkind = \"budget\"\n",
                       "rock.toml", {}));
  while (s.global().time < 0.5) s.step();
  EXPECT_EQ(column(s, "n_out"), 20);
  EXPECT_EQ(s.particle_count(), 0);
}

// A pressure drives it in.
TEST(Openings, PressureBringsFluidIn) {
  std::string by_pressure = inlet;
  by_pressure.replace(by_pressure.find("velocity = [[0, 20], [0.5, 30]]"), 31, "pressure = \"40 kPa\"");
  Simulation s(self(), sph::parse_scene(strip(by_pressure + outlet), "scene",
                                        {"start.velocity=[0, 0]", "group.magma.permeability="}));
  while (s.global().time < 0.5) s.step();
  EXPECT_GT(s.global().throughput.passages[0].beside, 0.05);
  const sph::Particles& p = s.particles();
  for (std::size_t i = 0; i < p.owned(); ++i)
    if (p.data<Field::buffer>()[i] == 1) {
      EXPECT_NEAR(p.data<Field::pressure>()[i], 4e4, 10);
    }
}

TEST(Openings, BoxesOfInletsMustBeFull) {
  EXPECT_THROW(Simulation(self(), sph::parse_scene(strip(inlet), "scene", {"start.lower=[2, 0]"})),
               sph::InputError);
}

TEST(Openings, BehindBoxesOfInletsIsNothing) {
  for (const bool turned : {false, true})
    EXPECT_THROW(
        Simulation(self(),
                   sph::parse_scene(
                       strip(inlet), "scene",
                       turned ? std::vector<std::string>{"inlet.0.direction=-x", "inlet.0.lower=[20, 0]",
                                                         "inlet.0.upper=[23, 12]"}
                              : std::vector<std::string>{"inlet.0.lower=[2, 0]", "inlet.0.upper=[5, 12]"})),
        sph::InputError);
}

}  // namespace
