// Terms that a number switches on, as XSPH in a scene; its sum is checked with all others (pair_formulas.cpp), its
// bits over ranks by the scene fluid2d of tests/system.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "grain_fixture.hpp"
#include "sph/models/parts.hpp"

namespace sph {
namespace {

Scene scene_of(const std::string& domain, const std::string& velocity, const char* strength) {
  return parse_scene(
      "domain = { lower = [0, 0], upper = [1, 1], " + domain +
          " }\nkernel = { h_over_dx = 1.2 }\ntime = { dt = 1e-4, steps = 1 }\n"
          "group = [{ name = \"water\", kind = \"fluid\", density = 1000, sound_speed = 20 }]\n"
          "start = { spacing = 0.04, region = [{ group = \"water\" }], velocity = " +
          velocity + " }",
      "box", {std::string("terms.xsph=") + strength});
}

/// After one step of a periodic box: sum of m times how far particles are from where they were without XSPH
/// [kg m], and that of its size.
std::array<double, 2> drift(const std::string& velocity) {
  static const decomp::Comm self(MPI_COMM_SELF);
  const auto run = [&](const char* strength) {
    auto scene = std::make_unique<Simulation>(self, scene_of("periodic = [true, true]", velocity, strength));
    scene->step();
    return scene;
  };
  const auto without = run("0"), with = run("0.5");
  const std::int64_t *a = without->particles().data<Field::position>(),
                     *b = with->particles().data<Field::position>();
  const double* mass = with->particles().data<Field::mass>();
  std::array<double, 2> sum{};
  for (std::size_t k = 0; k < 2 * with->particles().owned(); ++k) {
    const double way = mass[k / 2] * static_cast<double>(b[k] - a[k]) * with->scale().quantum;
    sum[0] += way;
    sum[1] += std::abs(way);
  }
  return sum;
}

TEST(AddedTerms, XsphDriftsWithoutMovingTheCentreOfMass) {
  const auto [all, size] = drift("\"taylor_green\"");
  EXPECT_GT(size, 1e-3);
  EXPECT_NEAR(all / size, 0, 1e-9);
}

TEST(AddedTerms, XsphLeavesACommonVelocityAlone) { EXPECT_EQ(drift("[3, 1]")[1], 0); }

// Lists count with a bound on how far a drift moves a particle. A drop at almost no speed is drawn together: after
// the first kick neighbours differ by far more than the largest speed that the step began with, and the drift is
// cut off at the bound, neither beyond it nor short of it.
TEST(AddedTerms, NoDriftIsLongerThanItsBound) {
  const decomp::Comm self(MPI_COMM_SELF);
  const std::string domain = "central_pull = 1e5, pull_centre = [0.5, 0.5]", velocity = "[0.01, 0]";
  Simulation without(self, scene_of(domain, velocity, "0")), with(self, scene_of(domain, velocity, "0.5"));
  double bound = 0;
  const Parts parts(self, with.scene(), with.scale());
  for (const Entry& entry : parts.plan.kick)
    for (const Stage& stage : entry.stages)
      if (stage.name == "xsph drift") bound = stage.moves(with.global());
  ASSERT_GT(bound, 0);
  without.step();
  with.step();
  const std::int64_t *a = without.particles().data<Field::position>(),
                     *b = with.particles().data<Field::position>();
  double longest = 0, fastest = 0;
  const double* v = with.particles().data<Field::velocity>();
  for (std::size_t k = 0; k < 2 * with.particles().owned(); k += 2) {
    const double quantum = with.scale().quantum, x = static_cast<double>(b[k] - a[k]) * quantum,
                 y = static_cast<double>(b[k + 1] - a[k + 1]) * quantum;
    longest = std::max(longest, std::hypot(x, y));
    fastest = std::max(fastest, std::hypot(v[k], v[k + 1]));
  }
  EXPECT_GT(fastest, 1);
  EXPECT_LE(longest, bound);
  EXPECT_GT(longest, 0.999 * bound);
}

}  // namespace
}  // namespace sph
