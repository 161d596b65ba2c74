// Grains in melts: the speed of one grain, what is conserved, beds at rest, what contacts make of them, refusals in a run.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "decomp/exact_sum.hpp"
#include "sph/core/error.hpp"
#include "sph/step/simulation.hpp"

namespace sph {
namespace {

#define EXPECT_SAYS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

const std::string tests_dir = PEPERITE_TEST_DIR;

const decomp::Comm& world() {
  static const decomp::Comm comm(MPI_COMM_WORLD);
  return comm;
}

// A grain half a cell wide, twice as dense as the melt around it, in a periodic box of 16 cells.
const std::string alone = R"(
contact.law = "linear"
drag.law = "stokes"
melt = {cells = [16, 16, 16], tolerance = 1e-6}
domain = {lower = [0, 0, 0], upper = [16, 16, 16], periodic = [true, true, true], gravity = [0, 0, -1]}
start.region = [{group = "magma"}]
start.grains = [{group = "crystal", lower = [8, 8, 8], upper = [9, 9, 9], spacing = 1}]
time.steps = 1
[[group]]
name = "magma"
kind = "melt"
density = 1
viscosity = 1
[[group]]
name = "crystal"
kind = "grain"
density = 2
diameter = 0.5
normal_stiffness = 1
)";

Scene scene(const std::vector<std::string>& overrides) { return parse_scene(alone, "alone", overrides); }

/// Sums over all grains, or cells, and ranks.
template <class Value>
double sum_of(const Simulation& s, bool grains, Value value) {
  decomp::ExactSum sum;
  const Particles& p = s.particles(grains ? s.grains()->set() : s.melt()->set());
  for (std::size_t i = 0; i < p.owned(); ++i) sum.add(value(p, i));
  decomp::ExactSum::all_reduce(s.comm(), std::span(&sum, 1));
  return sum.value();
}

double mean_speed_down(const Simulation& s) {
  const double n = sum_of(s, true, [](const Particles&, std::size_t) { return 1.0; });
  return -sum_of(s, true, [](const Particles& p, std::size_t i) {
    return p.data<Field::velocity>()[3 * i + 2];
  }) / n;
}

template <class Work>
std::string guard_text(Work&& work) {
  try {
    work();
  } catch (const GuardError& error) {
    return error.what();
  }
  return "(nothing)";
}

// Hasimoto (1959): images slow it by 2.837 a / L.
TEST(Suspension, OneGrainSinksAsStokesHasItWhereverItIs) {
  for (const double at : {8.0, 8.13, 8.31, 8.5}) {
    const std::string lower =
        "[" + std::to_string(at) + ", " + std::to_string(at - 0.2) + ", " + std::to_string(at + 0.1) + "]";
    const std::string upper = "[" + std::to_string(at + 1) + ", " + std::to_string(at + 0.8) + ", " +
                              std::to_string(at + 1.1) + "]";
    Simulation s(world(), scene({"start.grains=[{group=\"crystal\", lower=" + lower + ", upper=" + upper +
                                 ", spacing=1}]"}));
    s.step();
    const double alone_in_space = 0.25 / 18;
    EXPECT_NEAR(mean_speed_down(s) / alone_in_space, 1 - 2.837 * 0.25 / 16, 0.03) << at;
  }
}

TEST(Suspension, NeutralGrainsStayWhereTheyAre) {
  Simulation s(world(), scene({"group.crystal.density=1", "time.dt=1", "time.steps=3"}));
  for (int k = 0; k < 3; ++k) s.step();
  EXPECT_LT(std::fabs(mean_speed_down(s)), 1e-12);
}

// Its springs touch nothing: neither their stiffness nor how thin the melt is may show in what cells add up.
TEST(Suspension, WhatGrainsPutOnCellsIsInUnitsOfItsOwn) {
  constexpr double alone_in_space = 0.25 / 18;
  for (const char* stiffness : {"1e3", "1e-2", "1e-3"}) {
    Simulation s(world(), scene({std::string("group.crystal.normal_stiffness=") + stiffness}));
    s.step();
    EXPECT_NEAR(mean_speed_down(s) / alone_in_space, 1 - 2.837 * 0.25 / 16, 0.03) << stiffness;
  }
  for (const double warmer : {500.0, 1000.0}) {
    Simulation s(world(), scene({"melt.diffusivity=1e-3", "melt.viscosity_fall=0.01", "time.dt=1e-6",
                                 "group.magma.temperature=" + std::to_string(warmer)}));
    s.step();
    EXPECT_NEAR(mean_speed_down(s) / (alone_in_space * std::exp(0.01 * warmer)), 1 - 2.837 * 0.25 / 16, 0.03);
  }
}

// All that has a mass, by a power of two: no place and no time may change.
TEST(Suspension, NothingDependsOnTheUnitOfMass) {
  const auto run = [](double factor) {
    std::vector<std::string> more;
    for (const auto& [key, value] : {std::pair{"group.magma.density", 1.0},
                                     {"group.magma.viscosity", 1.0},
                                     {"group.crystal.density", 2.0},
                                     {"group.crystal.normal_stiffness", 1.0}}) {
      std::array<char, 80> text{};
      std::snprintf(text.data(), text.size(), "%s=%.17g", key, value * factor);
      more.emplace_back(text.data());
    }
    Simulation s(world(), scene(more));
    s.step();
    return std::pair{mean_speed_down(s), s.global().time};
  };
  const auto si = run(1);
  EXPECT_EQ(run(0x1p-40), si);
  EXPECT_EQ(run(0x1p40), si);
}

// Steps are counted: subtracted seconds left a rest of rounding, and a step too many, from some thousand steps on.
TEST(Suspension, AFlowServesAsManySteps) {
  Simulation s(world(), scene({"group.crystal.normal_stiffness=3e4", "time.dt=1"}));
  s.step();
  const std::int64_t steps = s.global().flow.left + 1;
  ASSERT_GT(steps, 7000);
  while (s.global().flow.left > 0) s.step();
  EXPECT_EQ(s.global().step, steps);
  EXPECT_NEAR(s.global().time, 1, 1e-9);
}

TEST(Suspension, WhatHasNoMeaningIsSaid) {
  Simulation light(world(),
                   scene({"melt.diffusivity=1e-3", "melt.expansion=0.1", "time.dt=1e4",
                          "melt.side=[{side=\"z0\", heat_flux=1}]", "domain.periodic=[true, true, false]"}));
  EXPECT_SAYS(guard_text([&] {
                for (int k = 0; k < 2000; ++k) light.step();
              }),
              "melt.expansion");
  Simulation soft(world(), scene({"group.magma.viscosity=1e-300"}));
  EXPECT_SAYS(guard_text([&] { soft.step(); }), "viscosities are");
}

/// tests/scenes/chamber.toml
Scene chamber(std::vector<std::string> overrides) {
  return read_scene(tests_dir + "/scenes/chamber.toml", overrides);
}

TEST(Suspension, AUniformCompositionStaysSoToTheBit) {
  Simulation s(world(), chamber({"start.region=[{group=\"heavy\"}]"}));
  for (int k = 0; k < 60; ++k) s.step();
  const Particles& cells = s.particles(s.melt()->set());
  for (std::size_t i = 0; i < cells.owned(); ++i) ASSERT_EQ(cells.data<Field::composition>()[i], 1.0);
}

TEST(Suspension, MeltAndGrainsFillTheDomainAndWhatTheyCarryStays) {
  Simulation s(world(), chamber({}));
  const auto content = [&] {
    return sum_of(s, false, [](const Particles& p, std::size_t i) {
      return p.data<Field::composition>()[i] * p.data<Field::melt_share>()[i];
    });
  };
  const auto melt = [&] {
    return sum_of(s, false, [](const Particles& p, std::size_t i) { return p.data<Field::melt_share>()[i]; });
  };
  s.step();
  const double content_before = content(), melt_before = melt();
  for (int k = 0; k < 100; ++k) s.step();
  EXPECT_NEAR(content() / content_before, 1, 1e-12);
  EXPECT_NEAR(melt() / melt_before, 1, 1e-12);
  const double of_cell = 32.0 * 16 * 24 / (14 * 8 * 12);
  const double grains = sum_of(s, true, [](const Particles& p, std::size_t i) {
    return std::numbers::pi * 4 / 3 * std::pow(p.data<Field::radius>()[i], 3);
  });
  EXPECT_NEAR(melt() + grains / of_cell, 14 * 8 * 12, 1e-6);
}

// A bed that its contacts hold: what is left of the flow is what a step of the springs leaves. A flow that did not meet
// them would be stable up to 2 eta / G: of three contacts a grain and ten grains a cell G = 30 k d^2 / 15 = 40 Pa, of
// 52 % eta = 13.5 Pa s, so 0.68 s; intervals are a hundred times as long.
TEST(Suspension, NothingFlowsInABedAtRest) {
  const std::vector<std::string> bed{
      "domain={lower=[0, 0, 0], upper=[8, 8, 8], periodic=[true, true, false], gravity=[0, 0, -1]}",
      "melt.cells=[8, 8, 8]",
      "melt.tolerance=1e-4",
      "start.grains=[{group=\"crystal\", lower=[0, 0, 0], upper=[8, 8, 2], spacing=0.5, jitter=0.02}]",
      "group.crystal.normal_stiffness=100",
      "group.crystal.diameter=[0.45, 0.5]",
      "wall=[{name=\"floor\", material=\"crystal\", point=[0, 0, 0], normal=[0, 0, 1]}]",
      "drag.law=richardson_zaki",
      "time.dt=68",
      "time.steps=100000"};
  Simulation s(world(), scene(bed));
  while (s.global().time < 18 * 68) s.step();
  EXPECT_EQ(s.global().flow.interval, 68);
  std::array<double, 1> largest{0};
  const Particles& cells = s.particles(s.melt()->set());
  for (std::size_t i = 0; i < 3 * cells.owned(); ++i)
    largest[0] = std::max(largest[0], std::fabs(cells.data<Field::velocity>()[i]));
  world().max(largest);
  EXPECT_GT(largest[0], 0);
  EXPECT_LT(largest[0], 1e-3 * 0.25 / 18);
  EXPECT_LT(std::fabs(mean_speed_down(s)), 1e-3 * 0.25 / 18);
}

TEST(Suspension, StepsAreRefusedWhereContactsAreTooStiff) {
  Simulation s(world(), scene({"group.crystal.normal_stiffness=1e12"}));
  EXPECT_SAYS(guard_text([&] { s.step(); }), "reduce the stiffness of grains");
}

TEST(Suspension, NothingFlowsAndThereIsNoStep) {
  Simulation s(world(), scene({"group.crystal.density=1"}));
  EXPECT_SAYS(guard_text([&] { s.step(); }), "nothing flows, and there is no time.dt: give one");
}

}  // namespace
}  // namespace sph
