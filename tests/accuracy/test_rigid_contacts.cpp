// Rigid bodies that touch each other, elastic ones and walls; what is held; starts that cannot be.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "accuracy/light_cylinder.hpp"
#include "accuracy/pinned.hpp"

namespace {

using measure::Sample, measure::samples, measure::run_until, measure::energy_of;
using sph::BodyState;

// Of fluid, elastic and rigid bodies that push each other, in a closed period.
TEST(Rigid, MomentumStays) {
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s(
      comm,
      sph::read_scene(PEPERITE_TEST_DIR "/scenes/rigid2d.toml",
                      {"domain.gravity=[0, 0]", "start.pressure=uniform", "start.uniform_pressure=2e5",
                       "start.surface_height=", "domain.lower=[0, 0]", "domain.upper=[76, 16]",
                       "domain.periodic=[true, true]", "start.region.1.group=melt", "group.wheel.held=[]"}));
  const auto momentum = [&] {
    std::array<double, 2> sum{};
    for (const Sample& q : samples(s))
      for (std::size_t a = 0; a < 2; ++a) sum[a] += q.mass * q.v[a];
    return sum;
  };
  const std::array<double, 2> before = momentum();
  const BodyState first = s.global().bodies.front();
  double size = 0;
  for (const Sample& q : samples(s)) size += q.mass * std::hypot(q.v[0], q.v[1]);
  run_until(s, 2);
  EXPECT_GT(std::abs(s.global().bodies.front().motion.velocity[1] - first.motion.velocity[1]), 0.005);
  for (std::size_t a = 0; a < 2; ++a) EXPECT_NEAR(momentum()[a], before[a], 1e-12 * size);
}

constexpr const char* dropped = R"(
dimension = 2
kernel = { h_over_dx = 1 }
domain = { lower = [-5, -5], upper = [30, 30] }
[[group]]
name = "block"
kind = "solid"
rigid = true
density = 1000
sound_speed = 100
[[group]]
name = "floor"
kind = "wall"
density = 1000
sound_speed = 100
[start]
spacing = 1
velocity = [0.3, -2]
region = [{ group = "none" }, { group = "floor", shape = "box", lower = [-5, -5], upper = [30, 0] },
          { group = "block", shape = "box", lower = [4, 4], upper = [12, 8] }]
[time]
cfl = 0.5
until = 10
)";

TEST(Rigid, ABlockBouncesWithItsEnergy) {
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s(comm, sph::parse_scene(dropped, "dropped.toml", {}));
  const double before = energy_of(s);
  double least = 1;
  run_until(s, 6, [&] { least = std::min(least, energy_of(s) / before); });
  EXPECT_GT(s.global().bodies.front().motion.velocity[1], 1.5);  // it has come back
  EXPECT_NEAR(PINNED(energy_of(s) / before), 1, 0.01);
}

// What is held keeps its motion whatever falls on it; the rest follows.
TEST(Rigid, HeldMotionsStay) {
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s(comm, sph::parse_scene(dropped, "held.toml",
                                           {"group.block.held=[\"x\", \"rotation\"]",
                                            "group.block.start_spin=0.2", "domain.gravity=[1, -1]"}));
  run_until(s, 5);
  const sph::BodyMotion& now = s.global().bodies.front().motion;
  EXPECT_NEAR(now.velocity[0], 0.3, 1e-12);
  EXPECT_EQ(now.spin[2], 0.2);
  EXPECT_NE(now.velocity[1], -2);
  EXPECT_NEAR(now.angle, 0.2 * s.global().time, 1e-12);
}

// What is found once particles are placed.
TEST(Rigid, BadStartsAreRefused) {
  const decomp::Comm comm(MPI_COMM_SELF);
  const auto says = [&](const std::vector<std::string>& overrides) -> std::string {
    try {
      sph::Simulation s(comm, sph::parse_scene(dropped, "bad.toml", overrides));
    } catch (const sph::InputError& error) {
      return error.what();
    }
    return "(accepted)";
  };
  const auto expect = [&](const std::vector<std::string>& overrides, const std::string& text) {
    EXPECT_NE(says(overrides).find("group.block.rigid: " + text), std::string::npos) << says(overrides);
  };
  expect({"start.region.2.upper=[5, 5]"}, "the particles of the body lie in one line");
  expect({"start.region.2.upper=[4.4, 4.4]"}, "the start has no particle of it");
  expect({"domain.periodic=[true, false]", "start.region.2.upper=[23, 8]"},
         "the body is half a period long in x or longer");
  EXPECT_EQ(says({"start.region.2.upper=[5, 5]", "group.block.held=[\"rotation\"]"}), "(accepted)");
}

}  // namespace
