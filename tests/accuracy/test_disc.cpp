// The Brazilian test: a disc of total-Lagrangian rock, 41 spacings across, squeezed between rigid platens. Under loads P on a
// diameter stress at its centre is 2 P / pi D across and -6 P / pi D along them. A disc of a lattice has flat ends, here 9
// particles wide, which carry most at their rims, as under any flat punch; of loads at an angle theta from the diameter
//   across 2 P / pi D cos theta (1 - 4 sin^2 theta), along -2 P / pi D cos theta (4 cos^2 theta - 1)
// (two simple radial distributions and a uniform tension, Timoshenko & Goodier 1970, 41), weighed by the contacts' own loads.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "accuracy/measure.hpp"
#include "accuracy/pinned.hpp"

namespace {

using measure::Sample, measure::samples, measure::run_until;

constexpr double radius = 20.5;

constexpr const char* squeezed = R"(
dimension = 2
domain = { lower = [-40, -40], upper = [40, 40] }
kernel = { h_over_dx = 1 }
[[group]]
name = "rock"
kind = "solid"
lagrangian = "total"
density = 1
bulk_modulus = 0.6666666666666667
shear_modulus = 0.4
viscosity = 0.5
[[group]]
name = "above"
kind = "solid"
rigid = true
density = 1
sound_speed = 1
held = ["x", "y", "rotation"]
start_velocity = [0, -2e-5]
[[group]]
name = "below"
kind = "solid"
rigid = true
density = 1
sound_speed = 1
held = ["x", "y", "rotation"]
start_velocity = [0, 2e-5]
[start]
spacing = 1
lower = [-30.5, -30.5]
upper = [30.5, 30.5]
region = [{ group = "none" }, { group = "rock", shape = "ball", centre = [0, 0], radius = 20.5 },
          { group = "above", shape = "box", lower = [-15, 20.5], upper = [15, 24] },
          { group = "below", shape = "box", lower = [-15, -24], upper = [15, -20.5] }]
[time]
cfl = 0.8
until = 1200
)";

/// What the platen above bears by each particle of the disc's end, in any unit, and at which angle.
struct Load {
  double weight, angle;
};

std::vector<Load> loads_of(const std::vector<Sample>& all) {
  std::vector<Load> out;
  for (const Sample& q : all) {
    if (q.group != 0 || q.x[1] < 0) continue;
    double weight = 0;
    for (const Sample& platen : all) {
      if (platen.group != 1) continue;
      const double x = platen.x[0] - q.x[0], y = platen.x[1] - q.x[1], r = std::hypot(x, y);
      if (r < 1) weight += (1 - r) * y / r;  // contact: spring as long as a spacing
    }
    if (weight > 0) out.push_back({weight, std::asin(q.x[0] / radius)});
  }
  return out;
}

TEST(Disc, SqueezedBetweenPlatens) {
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s(comm, sph::parse_scene(squeezed, "disc.toml", {}));
  run_until(s, 1200);
  const std::vector<Sample> all = samples(s);
  const double* stress = s.particles().data<sph::Field::stress>();
  double load = 0;
  std::array<double, 2> centre{};
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (all[k].group != 0 || std::abs(all[k].x[1]) > 0.3) continue;
    load += all[k].p - stress[3 * k + 1];
    if (std::abs(all[k].x[0]) < 0.3) centre = {stress[3 * k] - all[k].p, stress[3 * k + 1] - all[k].p};
  }
  double across = 0, along = 0, weights = 0;
  for (const Load& q : loads_of(all)) {
    const double c = std::cos(q.angle), t = std::sin(q.angle);
    across += q.weight * c * (1 - 4 * t * t);
    along -= q.weight * c * (4 * c * c - 1);
    weights += q.weight;
  }
  const double unit = load / (std::numbers::pi * radius) / weights;
  std::printf("disc: across %+.2f %%, along %+.2f %%; under loads on the diameter %+.1f, %+.1f %%\n",
              100 * (centre[0] / (unit * across) - 1), 100 * (centre[1] / (unit * along) - 1),
              100 * (centre[0] / (unit * weights) - 1), 100 * (centre[1] / (-3 * unit * weights) - 1));
  EXPECT_NEAR(PINNED(centre[0] / (unit * across)), 1, 0.03);
  EXPECT_NEAR(PINNED(centre[1] / (unit * along)), 1, 0.03);
}

}  // namespace
