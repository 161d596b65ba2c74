// Strength of updated-Lagrangian rock: patches in compression (accuracy.md E4), a strip footing, a vertical cut, a
// column that collapses.
#include <gtest/gtest.h>

#include <functional>

#include "accuracy/measure.hpp"
#include "accuracy/pinned.hpp"

namespace {

using measure::Sample, measure::samples, measure::run_until;
using sph::Field;

/// What a test imposes between steps, on a simulation that is its own.
template <Field F>
auto* imposed(sph::Simulation& s) {
  return const_cast<sph::Particles&>(s.particles(0)).data<F>();  // NOLINT: it is no constant
}

std::string patch(int dim, int n) {
  char text[1024];
  const char* corner = dim == 2 ? "0.5, 0.5" : "0.5, 0.5, 0.5";
  std::snprintf(text, sizeof text, R"(
dimension = %d
kernel = { h_over_dx = 1.2 }
domain = { lower = [%s], upper = [%s] }
[[group]]
name = "rock"
kind = "solid"
density = 2000
bulk_modulus = "10 GPa"
shear_modulus = "6 GPa"
strength = { cohesion = "1 MPa", friction_angle = 30 }
[start]
spacing = 1
lower = [%s]
upper = [%s]
pressure = "uniform"
uniform_pressure = 1e6
region = [{ group = "rock" }]
[time]
dt = 1e-4
until = 1
)",
                dim, dim == 2 ? "-30, -30" : "-30, -30, -30", dim == 2 ? "30, 30" : "30, 30, 30",
                dim == 2 ? "-10, -10" : "-7, -7, -7", dim == 2 ? "10, 10" : "7, 7, 7");
  (void)corner, (void)n;
  return text;
}

/// Mean stress along the axes of what is farther than a kernel from all faces.
std::array<double, 3> mean_stress(const sph::Simulation& s, double inside) {
  const auto d = static_cast<std::size_t>(s.scene().dim), n = d * (d + 1) / 2;
  const double *stress = s.particles().data<Field::stress>(), *p = s.particles().data<Field::pressure>();
  std::array<double, 3> sum{};
  int count = 0;
  const std::vector<Sample> all = samples(s);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (std::max({std::abs(all[i].x[0]), std::abs(all[i].x[1]), std::abs(all[i].x[2])}) > inside) continue;
    ++count;
    for (std::size_t a = 0; a < d; ++a) sum[a] += stress[i * n + a] - p[i];
  }
  for (double& x : sum) x /= count;
  return sum;
}

/// Greatest axial stress of a block that is shortened along y and held sideways by 1 MPa.
double strength_of_patch(int dim, const std::vector<std::string>& overrides) {
  constexpr double rate = 0.1, side = 1e6, M = 18e9;
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s(comm, sph::parse_scene(patch(dim, 0), "patch.toml", overrides));
  const auto d = static_cast<std::size_t>(dim);
  double lateral = 0, before = 0, top = 0, last = 0;
  for (int step = 0; step < 300; ++step) {
    const std::vector<Sample> all = samples(s);
    double* v = imposed<Field::velocity>(s);
    for (std::size_t i = 0; i < all.size(); ++i)
      for (std::size_t a = 0; a < d; ++a) v[i * d + a] = (a == 1 ? -rate : lateral) * all[i].x[a];
    s.step();
    const std::array<double, 3> stress = mean_stress(s, dim == 2 ? 5 : 3);
    const double error = stress[0] + side;
    lateral -= (0.2 * error + (error - before)) / (M * s.global().dt);
    before = error;
    top = std::max(top, -stress[1]);
    last = -stress[1];
    if (step % 30 == 0) std::printf("%d: %g %g %g\n", step, stress[0], stress[1], lateral);
  }
  std::printf("patch in %dD: %.4f MPa (last %.4f)\n", dim, top / 1e6, last / 1e6);
  return last / 1e6;
}

TEST(Strength, PatchInCompression) {
  const std::string cone = "group.rock.strength.law=drucker_prager";
  EXPECT_NEAR(PINNED(strength_of_patch(2, {})), 6.4641, 0.02 * 6.4641);
  EXPECT_NEAR(PINNED(strength_of_patch(3, {})), 6.4641, 0.02 * 6.4641);
  EXPECT_NEAR(PINNED(strength_of_patch(3, {cone})), 6.4641, 0.02 * 6.4641);
}

}  // namespace
