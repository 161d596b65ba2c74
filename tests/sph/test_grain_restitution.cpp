// Restitution as whole runs have it at the default step: impacts that begin at all parts of a step.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "grain_fixture.hpp"
#include "sph/laws/contact/hertz.hpp"
#include "sph/laws/contact/linear.hpp"
#include "sph/models/grain_limits.hpp"

namespace sph {
namespace {

using test::StartGrain;

const std::string linear = R"([contact]
law = "linear"
[[group]]
name = "sand"
kind = "grain"
density = 2500
diameter = [0.0007, 0.001]
normal_stiffness = 100
restitution = 0.5
)";
const std::string hertz = R"([contact]
law = "hertz"
[[group]]
name = "sand"
kind = "grain"
density = 2500
diameter = [0.0007, 0.001]
young_modulus = 1e7
poisson_ratio = 0.25
restitution = 0.5
)";
const std::string around = R"(dimension = 3
[domain]
lower = [0, 0, 0]
upper = [0.01, 0.21, 0.004]
[time]
steps = 1
[start]
file = "set later"
)";

/// Mean restitution of head-on impacts between grains of one radius, over the wanted one.
double mean_restitution(const std::string& law, double restitution, double radius, double speed, bool pull) {
  const decomp::Comm self(MPI_COMM_SELF);
  Scene scene = parse_scene(around + law, "impacts",
                            {"group.sand.restitution=" + std::to_string(restitution),
                             std::string("contact.pull=") + (pull ? "true" : "false")});
  const double dt = grain_step(scene);
  constexpr int pairs = 100;
  std::vector<StartGrain> grains;
  for (int p = 0; p < pairs; ++p) {
    const double y = 0.002 + 0.002 * p, gap = (3 + (p + 0.5) / pairs) * speed * dt;
    grains.push_back({"sand", {0.005 - radius, y, 0.002}, {0.6 * speed, 0, 0}, {}, radius});
    grains.push_back({"sand", {0.005 + radius + gap, y, 0.002}, {-0.4 * speed, 0, 0}, {}, radius});
  }
  const test::StartFile file(self, grains);
  scene.start.file = file.path();
  Simulation s(self, scene);
  const auto apart = [&] {
    for (std::uint64_t p = 0; p < pairs; ++p) {
      const test::GrainNow a = test::grain(s, 2 * p), b = test::grain(s, 2 * p + 1);
      if (!(b.x[0] - a.x[0] > 2 * radius && b.v[0] > a.v[0])) return false;
    }
    return true;
  };
  for (int n = 0; n < 3000 && !apart(); ++n) s.step();
  double mean = 0;
  for (std::uint64_t p = 0; p < pairs; ++p)
    mean += (test::grain(s, 2 * p + 1).v[0] - test::grain(s, 2 * p).v[0]) / (pairs * speed);
  return mean / restitution;
}

// The lightest pair takes 25 steps; the heaviest has 1.7 times as many.
TEST(GrainRestitution, LinearAtTheDefaultStep) {
  for (const double radius : {0.00035, 0.0005}) {
    EXPECT_NEAR(mean_restitution(linear, 0.9, radius, 0.05, false), 1, 1e-3) << radius;
    EXPECT_NEAR(mean_restitution(linear, 0.5, radius, 0.05, false), 1, 1e-3) << radius;
    EXPECT_NEAR(mean_restitution(linear, 0.1, radius, 0.05, false), 1, 2e-3) << radius;
    EXPECT_NEAR(mean_restitution(linear, 0.5, radius, 0.05, true), 1, 1e-3) << radius;
  }
}

// Overlaps of 0.3, 2 and 7 % of the radius, whose contacts take ever fewer steps.
TEST(GrainRestitution, HertzAtTheDefaultStep) {
  for (const double speed : {0.05, 0.5, 2.5}) {
    EXPECT_NEAR(mean_restitution(hertz, 0.9, 0.00035, speed, false), 1, 1e-3) << speed;
    EXPECT_NEAR(mean_restitution(hertz, 0.5, 0.00035, speed, false), 1, 1e-3) << speed;
    EXPECT_NEAR(mean_restitution(hertz, 0.1, 0.00035, speed, false), 1, 2e-3) << speed;
  }
}

TEST(GrainRestitution, SlopeOfAllRestitutions) {
  EXPECT_EQ(damping_slope(LinearNormal::impact, false, 1.0), 0.0);
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const double e : {1e-300, 1e-9, 1e-4, 1e-3, 0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 0.999999})
    for (const bool pull : {false, true})
      for (const ReducedImpact& law : {LinearNormal::impact, HertzNormal::impact}) {
        const double slope = damping_slope(law, pull, e), damping = damping_of(law, pull, e);
        EXPECT_LE(slope, 0) << e;
        EXPECT_GE(slope, -0.5 * damping * damping) << e;
        if (e > 1e-4 && e < 0.7) {
          EXPECT_NEAR(slope / (damping * damping), -0.23, 0.04) << e << pull;
        }
        hash = (hash ^ std::bit_cast<std::uint64_t>(slope)) * 0x100000001b3u;
      }
  EXPECT_EQ(hash, 0x4a2c0893c46b84eeu) << std::hex << hash;
}

}  // namespace
}  // namespace sph
