// Grains that come in and leave: how many, where, under which names, and what becomes of the contacts of those that are gone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "sph/core/error.hpp"
#include "sph/output/monitors.hpp"
#include "sph/step/simulation.hpp"

namespace {

using sph::Field;
using sph::Simulation;

const decomp::Comm& self() {
  static const decomp::Comm comm(MPI_COMM_SELF);
  return comm;
}

/// A box of 40 x 20 x 60 mm over a floor, periodic in y, with a lattice of `start` grains of 2 mm.
std::string box(const std::string& start, const std::string& more) {
  return "[domain]\nlower = [0, 0, 0]\nupper = [0.04, 0.02, 0.06]\nperiodic = [false, true, false]\n"
         "gravity = [0, 0, -9.81]\nleaves = \"delete\"\n[contact]\nlaw = \"linear\"\n"
         "[[group]]\nname = \"sand\"\nkind = \"grain\"\ndensity = 2500\ndiameter = [0.0015, 0.002]\n"
         "normal_stiffness = 500\nrestitution = 0.5\nfriction = 0.5\n"
         "[[wall]]\nname = \"floor\"\nmaterial = \"sand\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n"
         "[start]\nspacing = 0.002\nlower = [0, 0, 0]\nupper = " +
         start + "\n[[start.region]]\ngroup = \"sand\"\n[time]\nsteps = 9\n[[monitor]]\nkind = \"budget\"\n" +
         more;
}
const std::string little = "[0.002, 0.02, 0.002]";
const std::string no_grains = "start.region.0.group=none";
const std::string rain =
    "[[insertion]]\nlower = [0.01, 0, 0.04]\nupper = [0.03, 0.02, 0.05]\ngroup = \"sand\"\n"
    "rate = [[0, 0.02], [0.1, 0.04]]\nvelocity = [0.3, 0, -1]\n";

double column(Simulation& s, const std::string& name) {
  const sph::Monitors monitors(
      s, std::vector<std::optional<std::uint64_t>>(s.scene().output.monitors.size() - 1, 0));
  const std::vector<double> row = monitors.values(s);
  const auto at = std::ranges::find(monitors.names(), "budget_" + name);
  return row.at(static_cast<std::size_t>(at - monitors.names().begin()));
}

/// The deepest overlap of two grains, periodic in y [m].
double deepest(const Simulation& s) {
  const sph::Particles& p = s.particles();
  double most = -1;
  for (std::size_t i = 0; i < p.owned(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      double square = 0;
      for (std::size_t a = 0; a < 3; ++a) {
        double d =
            s.scale().metres(p.data<Field::position>()[3 * i + a] - p.data<Field::position>()[3 * j + a]);
        if (a == 1) d -= 0.02 * std::round(d / 0.02);
        square += d * d;
      }
      most = std::max(most, p.data<Field::radius>()[i] + p.data<Field::radius>()[j] - std::sqrt(square));
    }
  return most;
}

TEST(GrainOpenings, InsertionsBringTheirRate) {
  Simulation s(self(), sph::parse_scene(box(little, rain), "scene", {no_grains}));
  EXPECT_EQ(s.particle_count(), 0);
  const sph::Insertion& in = s.scene().domain.openings.insertions[0];
  // Through 10 mm from 1 m/s under g, or 20 mm at 0.3 m/s, whichever is sooner.
  EXPECT_NEAR(in.every, (std::sqrt(1 + 2 * 9.81 * 0.01) - 1) / 9.81, 1e-15);
  std::set<std::uint64_t> seen;
  const double grain = 2500 * M_PI / 6 * 8e-9;
  while (s.global().time < 0.05) {
    s.step();
    const double t = s.global().time, paid = std::min((std::floor(t / in.every) + 1) * in.every, 0.1);
    EXPECT_NEAR(column(s, "mass_in"), 0.02 * paid + 0.1 * paid * paid, 0.5 * grain);
    const sph::Particles& p = s.particles();
    bool came = false;
    for (std::size_t i = 0; i < p.owned(); ++i) {
      if (!seen.insert(p.data<Field::id>()[i]).second) continue;
      came = true;
      const double r = p.data<Field::radius>()[i];
      EXPECT_GE(r, 0.00075);
      EXPECT_LE(r, 0.001);
      EXPECT_DOUBLE_EQ(p.data<Field::mass>()[i], 2500 * (4 * M_PI / 3 * r * r * r));
      for (std::size_t a = 0; a < 3; ++a) {
        const double x = s.scale().metres(p.data<Field::position>()[3 * i + a]);
        EXPECT_GE(x - r, in.lower[a] - 1e-12);
        EXPECT_LE(x + r, in.upper[a] + 1e-12);
        EXPECT_EQ(p.data<Field::velocity>()[3 * i + a], in.velocity[a]);
      }
    }
    if (came) {
      EXPECT_LT(deepest(s), 0.1 * 0.001) << "of those that fell";
    }
  }
  EXPECT_GT(seen.size(), 100U);
  EXPECT_EQ(*seen.begin(), s.global().throughput.id_stride);
  EXPECT_EQ(*seen.rbegin() - *seen.begin() + 1, seen.size()) << "numbered as they came";
  EXPECT_EQ(column(s, "n_in") - column(s, "n_out"), static_cast<double>(s.particle_count()));
  EXPECT_NEAR(column(s, "mass"), column(s, "mass_in") - column(s, "mass_out"), 1e-12);
}

// None comes into grains or walls, and what found no place is not made up for.
TEST(GrainOpenings, FullBoxesTakeNoMore) {
  Simulation s(
      self(),
      sph::parse_scene(
          box(little,
              rain + "[[wall]]\nname = \"cut\"\nmaterial = \"sand\"\npoint = [0.02, 0, 0]\nnormal = [1, 0, "
                     "0.5]\n"),
          "scene",
          {no_grains, "domain.gravity=[0, 0, 0]", "insertion.0.velocity=[0, 0, 0]", "insertion.0.every=1e-3",
           "insertion.0.rate=[[0, 10], [9e-4, 10], [1e-3, 0]]"}));
  s.step();
  const std::int64_t most = s.particle_count();
  EXPECT_GT(most, 100);
  EXPECT_LE(deepest(s), 0);
  double volume = 0;
  const sph::Particles& p = s.particles();
  for (std::size_t i = 0; i < p.owned(); ++i) {
    const double r = p.data<Field::radius>()[i], n = std::sqrt(1.25);
    volume += 4 * M_PI / 3 * r * r * r;
    const std::int64_t* x = p.data<Field::position>() + 3 * i;
    EXPECT_GE(((s.scale().metres(x[0]) - 0.02) + 0.5 * s.scale().metres(x[2])) / n - r, -1e-12);
  }
  EXPECT_GT(volume, 0.2 * 0.02 * 0.02 * 0.01 * 0.7) << "random packings reach 0.3 and more";
  while (s.global().time < 3e-3) s.step();
  EXPECT_EQ(s.particle_count(), most) << "10 g that found no place";
}

TEST(GrainOpenings, WhatIsThrownUpFallsBack) {
  const auto every = [](const std::string& velocity) {
    return sph::parse_scene(box(little, rain), "scene", {no_grains, "insertion.0.velocity=" + velocity})
        .domain.openings.insertions[0]
        .every;
  };
  EXPECT_NEAR(every("[0, 0, 0.1]"), (0.1 + std::sqrt(0.01 + 2 * 9.81 * 0.01)) / 9.81, 1e-15);
  EXPECT_NEAR(every("[0, 0, 1]"), (1 - std::sqrt(1 - 2 * 9.81 * 0.01)) / 9.81, 1e-15) << "through the top";
  EXPECT_NEAR(every("[0, 0, 0]"), std::sqrt(2 * 0.01 / 9.81), 1e-15);
}

TEST(GrainOpenings, FacesAndOutletsDelete) {
  Simulation s(self(), sph::parse_scene(
                           box("[0.04, 0.02, 0.008]",
                               "[[outlet]]\nlower = [0.01, 0.004, -1e30]\nupper = [0.02, 0.016, 0.002]\n"),
                           "scene", {"start.velocity=[1.5, 0.2, 0]"}));
  const std::int64_t start = s.particle_count();
  const double mass = column(s, "mass");
  while (s.global().time < 0.015) {
    s.step();
    const sph::Particles& p = s.particles();
    for (std::size_t i = 0; i < p.owned(); ++i) {
      const std::int64_t* at = p.data<Field::position>() + 3 * i;
      const double x = s.scale().metres(at[0]), y = s.scale().metres(at[1]), z = s.scale().metres(at[2]);
      EXPECT_TRUE(x >= 0 && x < 0.04);
      EXPECT_FALSE(x > 0.01 && x < 0.02 && y > 0.004 && y < 0.016 && z < 0.002);
    }
  }
  const std::vector<sph::Passage>& passages = s.global().throughput.passages;
  ASSERT_EQ(passages.size(), 2U);
  EXPECT_GT(passages[0].count, 20);
  EXPECT_GT(passages[1].count, 20);
  EXPECT_GT(passages[1].momentum[0], 0);
  EXPECT_GT(passages[1].kinetic_energy, 0);
  EXPECT_EQ(s.particle_count(), start - passages[0].count - passages[1].count);
  EXPECT_NEAR(column(s, "mass") + column(s, "mass_out"), mass, 1e-12 * mass);
  // No contact remembers one that is gone, or the census of contacts had ended the run; those that are left go on.
  EXPECT_GT(s.grains()->pairs().lists().pairs().contacts(), 20);
  EXPECT_GT(s.grains()->pairs().counters().carried, 0);
}

/// Steps in which grains left a box that all of them come into within `duration` s.
std::int64_t departures(const std::string& outlet, double duration) {
  Simulation s(self(), sph::parse_scene(box("[0.01, 0.02, 0.005]",
                                            "[[outlet]]\nlower = [0, 0, 0.005]\n"
                                            "upper = [0.04, 0.02, 0.02]\n" +
                                                outlet),
                                        "scene",
                                        {"start.velocity=[0, 0, 1]", "domain.gravity=[0, 0, 0]",
                                         "start.spacing=0.0025", "start.jitter=0.1"}));
  const auto inside = [&] {
    std::int64_t count = 0;
    for (std::size_t i = 0; i < s.particles().owned(); ++i)
      count += s.scale().metres(s.particles().data<Field::position>()[3 * i + 2]) >= 0.005 ? 1 : 0;
    return count;
  };
  const double every = s.scene().domain.openings.outlets[0].every;
  std::int64_t steps = 0, most = 0;
  while (s.global().time < duration) {
    const double before = s.global().time;
    const std::int64_t count = s.particle_count();
    s.step();
    const bool opens = every == 0 || std::floor(s.global().time / every) > std::floor(before / every);
    EXPECT_TRUE(!opens || inside() == 0) << s.global().time;
    EXPECT_TRUE(opens || s.particle_count() == count) << s.global().time;
    most = std::max(most, inside());
    if (s.particle_count() < count) ++steps;
  }
  EXPECT_EQ(s.particle_count(), 0) << "all have come into it";
  EXPECT_TRUE(every == 0 || most > 10) << "some wait";
  return steps;
}

TEST(GrainOpenings, OutletsMayOpenNowAndThen) {
  EXPECT_GT(departures("", 0.006), 4);
  EXPECT_LE(departures("every = \"2 ms\"\n", 0.0061), 3);
}

// All of them, and the run goes on with none.
TEST(GrainOpenings, AllMayLeave) {
  Simulation s(self(), sph::parse_scene(box("[0.01, 0.02, 0.004]", ""), "scene",
                                        {"start.velocity=[1.5, 0, 0]", "wall.0.normal=[0, 0, 1]",
                                         "domain.gravity=[0, 0, 0]"}));
  EXPECT_GT(s.particle_count(), 50);
  while (s.global().time < 0.05) s.step();
  EXPECT_EQ(s.particle_count(), 0);
  EXPECT_EQ(column(s, "mass"), 0);
}

TEST(GrainOpenings, WithoutLeavesARunEnds) {
  Simulation s(self(), sph::parse_scene(box("[0.01, 0.02, 0.004]", ""), "scene",
                                        {"start.velocity=[1.5, 0, 0]", "domain.leaves=[\"x0\"]"}));
  EXPECT_THROW(while (s.global().time < 0.05) s.step(), sph::GuardError);
}

TEST(GrainOpenings, NoneComesFasterThanAnyMay) {
  EXPECT_THROW(Simulation(self(), sph::parse_scene(box(no_grains, rain), "scene",
                                                   {"insertion.0.velocity=[0, 0, -500]"})),
               sph::InputError);
}

}  // namespace
