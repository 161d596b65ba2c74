// The limits of check are those of the integrator: a jittered flow runs just below each, and blows up above.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "models/damping_limit.hpp"
#include "sph/step/simulation.hpp"
#include "start/start_sounds.hpp"

namespace sph::test {
namespace {

constexpr double step = 3e-3;  // c dt/h = 0.8

Scene flow(const std::string& key, double value) {
  return parse_scene(R"(
dimension = 2
[domain]
lower = [0, 0]
upper = [1, 1]
periodic = [true, true]
[kernel]
h_over_dx = 1.2
[[group]]
name = "water"
kind = "fluid"
density = 1000
sound_speed = 10
[start]
spacing = 0.03125
jitter = 0.2
velocity = "taylor_green"
flow_speed = 0.5
[[start.region]]
group = "water"
[time]
steps = 1
)",
                     "flow.toml", {"time.dt=" + std::to_string(step), key + "=" + std::to_string(value)});
}

/// True if density and speed stay near those of the start.
bool runs(const Scene& scene) {
  const decomp::Comm self(MPI_COMM_SELF);
  Simulation s(self, scene);
  try {
    for (int k = 0; k < 500; ++k) s.step();
  } catch (const GuardError&) {
    return false;
  }
  double worst = 0;
  for (std::size_t i = 0; i < s.particles().owned(); ++i)
    worst = std::max(worst, std::fabs(s.particles().data<Field::density>()[i] / 1000 - 1));
  return worst < 0.1 && s.global().max_speed < 1;
}

TEST(DampingLimit, IsWhereRunsBlowUp) {
  int size = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  if (size > 1) GTEST_SKIP() << "one rank is enough";
  for (const auto& [key, far] : {std::pair<std::string, double>{"terms.density_diffusion", 5},
                                 {"terms.artificial_viscosity", 40},
                                 {"group.water.bulk_viscosity", 1e5},
                                 {"group.water.viscosity", 1e4}}) {
    SCOPED_TRACE(key);
    const auto limit_of = [&](double value) {
      const Scene scene = flow(key, value);
      return damping_limit(scene, sounds_at_rest(scene), step);
    };
    const DampingLimit limit = limit_of(far);
    EXPECT_EQ(limit.key, key);
    EXPECT_EQ(limit.value, far);
    EXPECT_LT(limit.step, step);
    ASSERT_GT(limit.most, 0);
    EXPECT_GE(limit_of(0.999 * limit.most).step, step);
    EXPECT_TRUE(runs(flow(key, 0.9 * limit.most))) << limit.most;
    EXPECT_FALSE(runs(flow(key, 1.5 * limit.most))) << limit.most;
  }
}

TEST(DampingLimit, IsNotNoneHoweverShort) {
  Scene scene = flow("terms.artificial_viscosity", 0);
  scene.groups.front().viscosity = 1e21;
  const double longest = damping_limit(scene, sounds_at_rest(scene), step).step;
  // nu dt / h^2 of the Laplacian on the lattice is of order one there.
  const double h2 = 1.2 * 1.2 * 0.03125 * 0.03125;
  EXPECT_GT(longest * 1e18 / h2, 0.05);
  EXPECT_LT(longest * 1e18 / h2, 2);
}

}  // namespace
}  // namespace sph::test
