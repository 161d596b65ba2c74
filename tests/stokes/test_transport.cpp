#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <tuple>

#include "stokes/fields.hpp"
#include "stokes/partition.hpp"
#include "stokes/transport.hpp"

namespace {

using namespace stokes;
using namespace test_stokes;
using std::numbers::pi;

/// Around the middle of a closed unit square: from a stream function, so without sources.
Velocity vortex(const Patch& p) {
  const double h = p.grid.edge[0];
  const auto stream = [&](std::int64_t x, std::int64_t y) {
    return std::sin(pi * static_cast<double>(x) * h) * std::sin(pi * static_cast<double>(y) * h) / pi;
  };
  Velocity u;
  u.fill(Field(p.size, 0.0));
  for_cells(p, [&](std::ptrdiff_t k, const Int3& x) {
    u[0][k] = (stream(x[0], x[1] + 1) - stream(x[0], x[1])) / h;
    u[1][k] = -(stream(x[0] + 1, x[1]) - stream(x[0], x[1])) / h;
  });
  return u;
}

TEST(Transport, AStepInAVortexHasNoNewExtrema) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  const Grid g = unit_box(2, 64, Side::free_slip);
  Transport transport(comm, g, even_boxes(g, comm.size()));
  const Patch& p = transport.patch();
  const Velocity u = vortex(p);
  Field volume(p.size, 1.0), step(p.size, 0.0);
  for_cells(p, [&](std::ptrdiff_t k, const Int3& x) { step[k] = x[0] < 30 ? 1 : 0; });
  const double before = sum_over_cells(comm, p, [&](std::ptrdiff_t k) { return step[k] * volume[k]; });
  const double dt = transport.longest_step(u, 0.5);
  EXPECT_NEAR(dt, 0.5 * g.edge[0], 0.02 * g.edge[0]);  // |u| + |v| <= 1
  const Carried fields[]{{&step}};
  for (int n = 0; n < 400; ++n) {
    transport.advect(u, dt, volume, fields);
    for_cells(p, [&](std::ptrdiff_t k, const Int3&) {
      ASSERT_GE(step[k], -1e-13);
      ASSERT_LE(step[k], 1 + 1e-13);
      ASSERT_NEAR(volume[k], 1, 1e-12);
    });
  }
  const double after = sum_over_cells(comm, p, [&](std::ptrdiff_t k) { return step[k] * volume[k]; });
  EXPECT_NEAR(after, before, 1e-14 * before);
  // It has been wound up but not smeared out.
  const double mixed = sum_over_cells(comm, p, [&](std::ptrdiff_t k) { return step[k] * (1 - step[k]); });
  EXPECT_LT(mixed, 0.1 * 64 * 64);
  EXPECT_GT(mixed, 0.01 * 64 * 64);
}

TEST(Transport, ConservesWhatAVolumeThatChangesCarries) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  for (const int dim : {2, 3}) {
    Grid g = unit_box(dim, dim == 2 ? 48 : 16, Side::no_slip);
    g.sides[1] = {Side::periodic, Side::periodic};
    Transport transport(comm, g, even_boxes(g, comm.size()));
    const Patch& p = transport.patch();
    Field volume(p.size, 1.0), a = hashed_field(p, 1, 2, 1), b = hashed_field(p, 2, 100, 1);
    const Carried fields[]{{&a}, {&b}};
    const auto sums = [&] {
      return std::array{sum_over_cells(comm, p, [&](std::ptrdiff_t k) { return volume[k]; }),
                        sum_over_cells(comm, p, [&](std::ptrdiff_t k) { return a[k] * volume[k]; }),
                        sum_over_cells(comm, p, [&](std::ptrdiff_t k) { return b[k] * volume[k]; })};
    };
    const auto before = sums();
    for (unsigned n = 0; n < 300; ++n)
      transport.advect(hashed_velocity(p, n, 0.005), g.edge[0], volume, fields);
    double most = 0;
    for_cells(p, [&](std::ptrdiff_t k, const Int3&) {
      ASSERT_GT(volume[k], 0.2);
      most = std::max(most, std::fabs(volume[k] - 1));
    });
    EXPECT_TRUE(p.own.empty() || most > 0.1);
    const auto after = sums();
    for (std::size_t k = 0; k < before.size(); ++k) EXPECT_NEAR(after[k], before[k], 1e-14 * before[k]) << k;
  }
}

TEST(Transport, WhatIsUniformStaysSoToTheBit) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  for (const int dim : {2, 3})
    for (const Side side : {Side::periodic, Side::free_slip, Side::no_slip}) {
      const Grid g = unit_box(dim, 16, side);
      Transport transport(comm, g, even_boxes(g, comm.size()));
      const Patch& p = transport.patch();
      const double value = 1.0 / 3;
      Field volume(p.size, 1.0), c(p.size, value);
      const Carried fields[]{{&c}};
      for (unsigned n = 0; n < 20; ++n)
        transport.advect(hashed_velocity(p, n, 1), 0.02 * g.edge[0], volume, fields);
      for_cells(p, [&](std::ptrdiff_t k, const Int3&) { ASSERT_EQ(c[k], value); });
    }
}

/// Mean of |C - exact| of a hump that has gone along the diagonal of a periodic box.
double hump(int dim, std::int64_t n) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  const Grid g = unit_box(dim, n, Side::periodic);
  Transport transport(comm, g, even_boxes(g, comm.size()));
  const Patch& p = transport.patch();
  const double time = 0.25;
  const auto exact = [&](const Int3& x, double t) {
    double product = 1;
    for (std::size_t a = 0; a < static_cast<std::size_t>(dim); ++a)
      product *= 0.5 + 0.5 * std::cos(2 * pi * ((static_cast<double>(x[a]) + 0.5) * g.edge[a] - t));
    return product;
  };
  Field volume(p.size, 1.0), c(p.size, 0.0), error(p.size, 0.0);
  Velocity u;
  u.fill(Field(p.size, 1.0));
  for_cells(p, [&](std::ptrdiff_t k, const Int3& x) { c[k] = exact(x, 0); });
  const auto steps = static_cast<int>(std::ceil(time / transport.longest_step(u, 0.5) * (1 - 1e-12)));
  const Carried fields[]{{&c}};
  for (int s = 0; s < steps; ++s) transport.advect(u, time / steps, volume, fields);
  for_cells(p, [&](std::ptrdiff_t k, const Int3& x) { error[k] = std::fabs(c[k] - exact(x, time)); });
  return sum_over_cells(comm, p, [&](std::ptrdiff_t k) { return error[k]; }) /
         std::pow(static_cast<double>(n), dim);
}

TEST(Transport, ASmoothHumpIsOfSecondOrder) {
  for (const int dim : {2, 3}) {
    const std::int64_t n = dim == 2 ? 32 : 24;
    const double coarse = hump(dim, n), fine = hump(dim, 2 * n);
    EXPECT_GT(std::log2(coarse / fine), 1.8) << dim << "D " << coarse << ' ' << fine;
  }
}

// Up from a wall of temperature 1, in what decreases evenly from there: mirror images would make cells at the wall extrema,
// whose upper faces have no more than their mean.
TEST(Transport, WhatLeavesAWallThatKeepsATemperatureHasItsSlope) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  const Grid g = unit_box(2, 16, Side::free_slip);
  ThermalWalls walls;
  walls[1][0] = {ThermalWall::Kind::temperature, 1};
  const Conduction conduction(comm, g, even_boxes(g, comm.size()), 1, walls);
  Transport transport(comm, g, even_boxes(g, comm.size()));
  const Patch& p = transport.patch();
  Field volume(p.size, 1.0), t(p.size, 0.0);
  Velocity u;
  u.fill(Field(p.size, 0.0));
  const double h = g.edge[1];
  for_cells(p, [&](std::ptrdiff_t k, const Int3& x) {
    t[k] = 1 - (static_cast<double>(x[1]) + 0.5) * h;
    u[1][k] = x[1] == 1 ? 1 : 0;
  });
  const Field before = t;
  const Carried fields[]{{&t, &conduction}};
  transport.advect(u, 1e-3 * h, volume, fields);
  for_cells(p, [&](std::ptrdiff_t k, const Int3& x) {
    const double gone = (before[k] - volume[k] * t[k]) / 1e-3;
    EXPECT_NEAR(gone, x[1] == 0 ? 1 - h : x[1] == 1 ? h - 1 : 0, 1e-3 * h);
  });
}

// A cell without volume keeps what it has, and the next ones do not notice.
TEST(Transport, CellsWithoutVolumeStayAsTheyAre) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  const Grid g = unit_box(2, 16, Side::periodic);
  Transport transport(comm, g, even_boxes(g, comm.size()));
  const Patch& p = transport.patch();
  Field volume(p.size, 1.0), c = hashed_field(p, 1, 0, 1);
  Velocity u;
  u.fill(Field(p.size, 0.0));
  for_cells(p, [&](std::ptrdiff_t k, const Int3& x) {
    if (x[1] == 5) volume[k] = 0;
    u[0][k] = x[1] == 5 ? 0 : 1;
  });
  const Field before = c;
  const Carried fields[]{{&c}};
  for (int n = 0; n < 10; ++n) transport.advect(u, 0.5 * g.edge[0], volume, fields);
  for_cells(p, [&](std::ptrdiff_t k, const Int3& x) {
    EXPECT_EQ(volume[k], x[1] == 5 ? 0 : 1);
    EXPECT_LE(std::fabs(c[k]), 1);
    EXPECT_TRUE(x[1] != 5 || c[k] == before[k]);
  });
  u[0].assign(p.size, 0.0);
  EXPECT_TRUE(std::isinf(transport.longest_step(u, 0.5)));
}

TEST(Transport, BitsAreThoseOfOneRank) {
  const decomp::Comm world(MPI_COMM_WORLD), alone(MPI_COMM_SELF);
  for (const int dim : {2, 3})
    for (unsigned seed = 0; seed < 12; ++seed) {
      std::mt19937 random(seed);
      Grid g = unit_box(dim, dim == 2 ? Int3{40, 24, 1} : Int3{16, 8, 12}, Side::free_slip);
      for (std::size_t a = 0; a < static_cast<std::size_t>(dim); ++a) {
        const auto side = static_cast<Side>(random() % 3), other = static_cast<Side>(1 + random() % 2);
        g.sides[a] = {side, side == Side::periodic ? side : other};
      }
      ThermalWalls walls;
      for (std::size_t a = 0; a < static_cast<std::size_t>(dim); ++a)
        for (ThermalWall& wall : walls[a]) wall = {static_cast<ThermalWall::Kind>(random() % 3), 0.5};
      const auto run = [&](const decomp::Comm& comm, const std::vector<Box>& boxes) {
        Transport transport(comm, g, boxes);
        const Conduction conduction(comm, g, boxes, 0.1, walls);
        const Patch& p = transport.patch();
        Field volume = hashed_field(p, seed, 1, 0.3), a = hashed_field(p, 1, 2, 1),
              b = hashed_field(p, 2, 0, 1);
        const Carried fields[]{{&a}, {&b, &conduction}};
        double dt = 0;
        for (unsigned n = 0; n < 10; ++n) {
          const Velocity u = hashed_velocity(p, n + 100 * seed, 1);
          dt = transport.longest_step(u, 0.05);
          transport.advect(u, dt, volume, fields);
        }
        return std::tuple(p, dt, std::array{std::move(volume), std::move(a), std::move(b)});
      };
      const auto [whole, dt, expected] = run(alone, {g.box()});
      const auto axis = static_cast<std::size_t>(seed / 2 % static_cast<unsigned>(dim));
      const auto [part, dt_here, got] = run(
          world, seed % 2 == 0 ? even_boxes(g, world.size()) : random_boxes(g, axis, world.size(), random));
      EXPECT_EQ(dt_here, dt);
      for (std::size_t f = 0; f < got.size(); ++f)
        EXPECT_EQ(other_bits(part, got[f], whole, expected[f]), 0U) << dim << "D, seed " << seed << ' ' << f;
    }
}

}  // namespace
