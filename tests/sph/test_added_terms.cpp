// Terms that a number switches on, as XSPH in a scene; its sum is checked with all others (pair_formulas.cpp), its
// bits over ranks by taylor_green.toml with terms.xsph in tests/recorded.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "grain_fixture.hpp"

namespace sph {
namespace {

/// After one step of a periodic box: sum of m times how far particles are from where they were without XSPH
/// [kg m], and that of its size.
std::array<double, 2> drift(const std::string& velocity) {
  static const decomp::Comm self(MPI_COMM_SELF);
  const auto run = [&](const char* strength) {
    auto scene = std::make_unique<Simulation>(
        self,
        parse_scene("domain = { lower = [0, 0], upper = [1, 1], periodic = [true, true] }\n"
                    "kernel = { h_over_dx = 1.2 }\ntime = { dt = 1e-4, steps = 1 }\n"
                    "group = [{ name = \"water\", kind = \"fluid\", density = 1000, sound_speed = 20 }]\n"
                    "start = { spacing = 0.04, region = [{ group = \"water\" }], velocity = " +
                        velocity + " }",
                    "box", {std::string("terms.xsph=") + strength}));
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

}  // namespace
}  // namespace sph
