#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <tuple>

#include "stokes/conduction.hpp"
#include "stokes/fields.hpp"
#include "stokes/partition.hpp"

namespace {

using namespace stokes;
using namespace test_stokes;
using std::numbers::pi;
using Kind = ThermalWall::Kind;

double centre(const Grid& g, const Int3& x, std::size_t axis) {
  return (static_cast<double>(x[axis]) + 0.5) * g.edge[axis];
}

TEST(Conduction, InsulatingWallsKeepHeat) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  for (const int dim : {2, 3})
    for (const double theta : {0.5, 1.0}) {
      Grid g = unit_box(dim, 16, Side::no_slip);
      g.sides[0] = {Side::periodic, Side::periodic};
      Conduction conduction(comm, g, even_boxes(g, comm.size()), 0.3, {});
      const Patch& p = conduction.patch();
      Field t = hashed_field(p, 1, 300, 20), uniform(p.size, 1.0 / 3);
      const Field volume = hashed_field(p, 2, 1, 0.05);
      const auto heat = [&] {
        return sum_over_cells(comm, p, [&](std::ptrdiff_t k) { return volume[k] * t[k]; });
      };
      const double before = heat();
      for (int n = 0; n < 50; ++n) {
        (void)conduction.advance(0.01, t, theta, &volume);
        (void)conduction.advance(0.01, uniform, theta, &volume);
      }
      EXPECT_NEAR(heat(), before, 1e-14 * before);
      for_cells(p, [&](std::ptrdiff_t k, const Int3&) { ASSERT_EQ(uniform[k], 1.0 / 3); });
    }
}

TEST(Conduction, AProfileBetweenTwoWallsStays) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  const double kappa = 2;
  for (const int dim : {2, 3})
    for (const Kind upper : {Kind::temperature, Kind::flux}) {
      const Grid g = unit_box(dim, 16, Side::no_slip);
      const int axis = dim - 1;
      const auto a = static_cast<std::size_t>(axis);
      ThermalWalls walls;
      walls[a] = {ThermalWall{Kind::temperature, 5},
                  ThermalWall{upper, upper == Kind::temperature ? 8 : 3 * kappa}};
      Conduction conduction(comm, g, even_boxes(g, comm.size()), kappa, walls);
      const Patch& p = conduction.patch();
      Field t(p.size, 0.0), from_zero = t;
      for_cells(p, [&](std::ptrdiff_t k, const Int3& x) { t[k] = 5 + 3 * centre(g, x, a); });
      for (int n = 0; n < 16; ++n) {
        (void)conduction.advance(0.1, t, 0.5);
        (void)conduction.advance(1, from_zero);
      }
      for_cells(p, [&](std::ptrdiff_t k, const Int3& x) {
        ASSERT_NEAR(t[k], 5 + 3 * centre(g, x, a), 1e-12 * 5);
        ASSERT_NEAR(from_zero[k], t[k], 1e-10);
      });
      EXPECT_NEAR(conduction.mean_inflow(t, axis, 1), 3 * kappa, 1e-11);
      EXPECT_NEAR(conduction.mean_inflow(t, axis, 0), -3 * kappa, 1e-11);
      EXPECT_EQ(conduction.mean_inflow(t, 0, 0), 0);
    }
}

// Of a field that is a wave of the grid one step is known: (1 - (1 - theta) z) / (1 + theta z).
TEST(Conduction, AStepIsThatOfTheThetaScheme) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  const double kappa = 0.7;
  for (const int dim : {2, 3})
    for (const double theta : {0.5, 0.8, 1.0})
      for (const double dt : {1e-7, 1e-4, 1e-2, 1.0}) {
        Grid g = unit_box(dim, {24, 16, 8}, Side::no_slip);
        if (dim == 3) g.sides[2] = {Side::periodic, Side::periodic};
        ThermalWalls walls;
        walls[1].fill({Kind::temperature, 0});
        Conduction conduction(comm, g, even_boxes(g, comm.size()), kappa, walls);
        const Patch& p = conduction.patch();
        Field t(p.size, 0.0);
        for_cells(p, [&](std::ptrdiff_t k, const Int3& x) {
          t[k] = std::cos(3 * pi * centre(g, x, 0)) * std::sin(2 * pi * centre(g, x, 1)) *
                 (dim == 3 ? std::cos(2 * pi * centre(g, x, 2)) : 1.0);
        });
        double z = 0;
        for (std::size_t a = 0; a < static_cast<std::size_t>(dim); ++a)
          z += dt * kappa * (2 - 2 * std::cos((a == 0 ? 3 : 2) * pi * g.edge[a])) / (g.edge[a] * g.edge[a]);
        const Field before = t;
        (void)conduction.advance(dt, t, theta);
        const double factor = (1 - (1 - theta) * z) / (1 + theta * z);
        for_cells(p, [&](std::ptrdiff_t k, const Int3&) {
          ASSERT_NEAR(t[k], factor * before[k], 1e-11) << dim << "D " << theta << ' ' << dt;
        });
      }
}

/// Error of the amplitude of cos(pi x) at t = 0.1, relative, in space or in time alone.
double decay(std::int64_t n, int steps, double theta, bool in_time) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  const Grid g = unit_box(2, {n, 8, 1}, Side::no_slip);
  Conduction conduction(comm, g, even_boxes(g, comm.size()), 1, {});
  const Patch& p = conduction.patch();
  Field t(p.size, 0.0);
  for_cells(p, [&](std::ptrdiff_t k, const Int3& x) { t[k] = std::cos(pi * centre(g, x, 0)); });
  for (int s = 0; s < steps; ++s) (void)conduction.advance(0.1 / steps, t, theta);
  const double h = g.edge[0], of_grid = (2 - 2 * std::cos(pi * h)) / (h * h);
  const double exact = std::exp(-0.1 * (in_time ? of_grid : pi * pi));
  double worst = 0;
  for_cells(p, [&](std::ptrdiff_t k, const Int3& x) {
    worst = std::max(worst, std::fabs(t[k] / (exact * std::cos(pi * centre(g, x, 0))) - 1));
  });
  std::array all{worst};
  comm.max(all);
  return all[0];
}

TEST(Conduction, DecayIsOfSecondOrder) {
  EXPECT_NEAR(std::log2(decay(16, 8, 0.5, true) / decay(16, 16, 0.5, true)), 2, 0.05);
  EXPECT_NEAR(std::log2(decay(16, 32, 1, true) / decay(16, 64, 1, true)), 1, 0.1);
  EXPECT_NEAR(std::log2(decay(16, 200, 0.5, false) / decay(32, 400, 0.5, false)), 2, 0.05);
}

TEST(Conduction, BitsAreThoseOfOneRank) {
  const decomp::Comm world(MPI_COMM_WORLD), alone(MPI_COMM_SELF);
  for (const int dim : {2, 3})
    for (unsigned seed = 0; seed < 12; ++seed) {
      std::mt19937 random(seed);
      Grid g = unit_box(dim, dim == 2 ? Int3{40, 24, 1} : Int3{16, 8, 12}, Side::no_slip);
      ThermalWalls walls;
      for (std::size_t a = 0; a < static_cast<std::size_t>(dim); ++a) {
        if (random() % 3 == 0) g.sides[a].fill(Side::periodic);
        for (ThermalWall& wall : walls[a])
          wall = {static_cast<Kind>(random() % 3), static_cast<double>(random()) * 0x1p-32};
      }
      const auto run = [&](const decomp::Comm& comm, const std::vector<Box>& boxes) {
        Conduction conduction(comm, g, boxes, 0.1, walls);
        const Patch& p = conduction.patch();
        Field t = hashed_field(p, seed, 1, 0.3);
        int iterations = 0;
        for (int n = 0; n < 3; ++n) iterations += conduction.advance(0.01, t, n == 0 ? 1 : 0.5);
        const double inflow = conduction.mean_inflow(t, static_cast<int>(seed % 2), 1);
        return std::tuple(p, std::move(t), iterations, inflow);
      };
      const auto [whole, expected, iterations, inflow] = run(alone, {g.box()});
      const auto axis = static_cast<std::size_t>(seed / 2 % static_cast<unsigned>(dim));
      const auto [part, got, iterations_here, inflow_here] = run(
          world, seed % 2 == 0 ? even_boxes(g, world.size()) : random_boxes(g, axis, world.size(), random));
      EXPECT_EQ(iterations_here, iterations);
      EXPECT_EQ(inflow_here, inflow);
      EXPECT_EQ(other_bits(part, got, whole, expected), 0U) << dim << "D, seed " << seed;
    }
}

}  // namespace
