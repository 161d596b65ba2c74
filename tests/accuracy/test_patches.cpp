// Updated-Lagrangian solids: rotation and simple shear of a patch whose motion is given (accuracy.md B3, B4).
#include <gtest/gtest.h>

#include "accuracy/bodies.hpp"
#include "accuracy/pinned.hpp"
#include "sph/output/snapshot.hpp"

namespace {

using measure::Bodies, measure::Sample, measure::samples, measure::run_until;
using sph::Field;

constexpr const char* updated_patch = R"(
dimension = 2
[domain]
lower = [-3, -3]
upper = [3, 3]
[kernel]
h_over_dx = 1.2
[[group]]
name = "patch"
kind = "solid"
density = 1000
bulk_modulus = 1e6
shear_modulus = 1e6
[start]
spacing = 0.05
file = "patch.csv"
[time]
cfl = 0.1
until = 1
)";

// B3: a patch so heavy that its particles fly straight on, x(t) = (1 + W (t - 1)) X, shrinks and grows again
// while it turns by 90 degrees. Its stress turns with it: xx and yy change places.
TEST(Solids, UpdatedPatchInRotation) {
  const decomp::Comm comm(MPI_COMM_SELF);
  constexpr int n = 40;
  constexpr double dx = 1.0 / n, rho = 1e14, stress = 1e6;
  const sph::PositionScale scale{0x1p-50, {}};
  sph::Particles p(2, {Field::id, Field::position, Field::velocity, Field::density, Field::mass, Field::group,
                       Field::stress});
  p.table().resize(n * n, 0);
  for (std::size_t k = 0; k < n * n; ++k) {
    const double x = (static_cast<double>(k % n) + 0.5) * dx - 0.5,
                 y = (static_cast<double>(k / n) + 0.5) * dx - 0.5;
    p.data<Field::id>()[k] = k;
    p.data<Field::position>()[2 * k] = scale.quanta(x + y);
    p.data<Field::position>()[2 * k + 1] = scale.quanta(y - x);
    p.data<Field::velocity>()[2 * k] = -y;
    p.data<Field::velocity>()[2 * k + 1] = x;
    p.data<Field::density>()[k] = rho / 2;
    p.data<Field::mass>()[k] = rho * dx * dx;
    p.data<Field::group>()[k] = 0;
    p.data<Field::stress>()[3 * k] = 2 * stress, p.data<Field::stress>()[3 * k + 1] = -stress;
    p.data<Field::stress>()[3 * k + 2] = 0;
  }
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("peperite_" + std::to_string(getpid()) + ".h5");
  sph::write_snapshot(comm, file, p, {}, scale, {}, {updated_patch, "", {"patch"}}, {}, n * n);
  sph::Simulation s(comm, sph::parse_scene(updated_patch, "solid.toml",
                                           {"start.file=" + file.string(), "start.spacing=0.025",
                                            "group.patch.density=1e14", "time.dt=2e-3", "time.cfl="}));
  std::filesystem::remove(file);
  run_until(s, 2 - 1e-9);
  double xx = 0, yy = 0, xy = 0;
  int count = 0;
  const std::vector<Sample> all = samples(s);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (std::hypot(all[i].x[0], all[i].x[1]) > 0.4) continue;
    const double* d = s.particles().data<Field::stress>() + 3 * i;
    xx += d[0] / stress, yy += d[1] / stress, xy += d[2] / stress, ++count;
  }
  xx /= count, yy /= count, xy /= count;
  const double before = 0.25 * 9, after = 0.25 * (xx - yy) * (xx - yy) + xy * xy;
  std::printf("quarter turn, updated: s_xx %.4f (-1), s_yy %.4f (2), s_xy %.4f (0), invariant %+.1e\n", xx,
              yy, xy, after / before - 1);
  EXPECT_NEAR(PINNED(xx), -1, 0.002);
  EXPECT_NEAR(PINNED(yy), 2, 0.002);
  EXPECT_NEAR(PINNED(xy), 0, 0.003);
  EXPECT_NEAR(after / before, 1, 2e-12);
}

// B4: the patch is so heavy that nothing changes its velocity, v_x = y.
TEST(Solids, UpdatedPatchInSimpleShear) {
  const decomp::Comm comm(MPI_COMM_SELF);
  constexpr int n = 40;
  Bodies patch(1e14);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double x = (i + 0.5) / n - 0.5, y = (j + 0.5) / n - 0.5;
      patch.add(x, y, y, 0);
    }
  sph::Simulation s =
      patch.start(comm, updated_patch, 1.0 / n, {"group.patch.density=1e14", "time.dt=2e-3", "time.cfl="});
  run_until(s, 1);
  double xy = 0, xx = 0, yy = 0;
  int count = 0;
  const std::vector<Sample> all = samples(s);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (std::abs(all[i].x[1]) > 0.2 || std::abs(all[i].x[0] - all[i].x[1]) > 0.2) continue;
    const double* d = s.particles().data<Field::stress>() + 3 * i;
    xx += d[0], yy += d[1], xy += d[2], ++count;
  }
  std::printf("simple shear to 1, updated: s_xy %.4f G (0.8415), s_xx %.4f G (0.4597), s_yy %.4f G\n",
              xy / count / 1e6, xx / count / 1e6, yy / count / 1e6);
  EXPECT_NEAR(PINNED(xy / count / 1e6), 0.841471, 0.003 * 0.841471);
  EXPECT_NEAR(PINNED(xx / count / 1e6), 0.459698, 0.003 * 0.459698);
  EXPECT_NEAR(PINNED(yy / count / 1e6), -0.459698, 0.003 * 0.459698);
}

// A strip slides through a fluid without viscosity: nothing slows it. With the shear stress of the solid
// between unlike particles it has a quarter of its velocity left at 0.25 s, and 0.62 of it at the end.
TEST(Solids, UpdatedStripSlipsPastFluid) {
  const decomp::Comm comm(MPI_COMM_SELF);
  constexpr int n = 20;
  constexpr double dx = 1.0 / n;
  Bodies bodies(1);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const bool strip = j >= n / 4 && j < 3 * n / 4;
      bodies.add((i + 0.5) * dx, (j + 0.5) * dx, strip ? 0.5 : -0.5, 0, strip ? 1 : 0);
    }
  sph::Simulation s = bodies.start(comm, R"(
dimension = 2
[domain]
lower = [0, 0]
upper = [1, 1]
periodic = [true, true]
[kernel]
h_over_dx = 1.2
[[group]]
name = "fluid"
kind = "fluid"
density = 1
sound_speed = 10
[[group]]
name = "strip"
kind = "solid"
density = 1
sound_speed = 10
poisson_ratio = 0.25
[start]
spacing = 0.05
file = "strip.csv"
[time]
cfl = 0.8
until = 0.5
)",
                                   dx);
  run_until(s, 0.5 - 1e-9);
  double mean = 0;
  for (const Sample& q : samples(s)) mean += q.group == 1 ? q.v[0] / (0.5 * n * n) : 0;
  std::printf("strip past fluid: velocity %.4f of the first\n", mean / 0.5);
  EXPECT_NEAR(PINNED(mean / 0.5), 1, 0.001);
}

}  // namespace
