#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <tuple>

#include "stokes/fields.hpp"
#include "stokes/partition.hpp"
#include "stokes/solcx.hpp"
#include "stokes/solved.hpp"
#include "stokes/solver.hpp"

namespace {

using namespace stokes;
using namespace test_stokes;
using std::numbers::pi;

Solved solcx(std::int64_t n) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  const Grid g = unit_box(2, n, Side::free_slip);
  Solver solver(comm, g, even_boxes(g, comm.size()));
  const Patch& p = solver.patch();
  const double h = g.edge[0];
  Flow x = solver.make_flow();
  Velocity force = solver.make_flow().u;
  Field eta(p.size, 1.0);
  for_corners(p, [&](std::ptrdiff_t k, const std::array<double, 3>& at) {
    eta[k] = at[0] + 0.5 * h < 0.5 ? 1 : 1e6;
    force[1][k] = std::sin(pi * at[1]) * std::cos(pi * (at[0] + 0.5 * h));
  });
  solver.set_viscosity(eta);
  Solved out{solver.solve(force, x, 1e-8), {}};
  const SolCx exact(1e6);
  Norms norms;
  for_corners(p, [&](std::ptrdiff_t k, const std::array<double, 3>& at) {
    norms.add(0, x.u[0][k], exact.u(at[0], at[1] + 0.5 * h));
    norms.add(0, x.u[1][k], exact.v(at[0] + 0.5 * h, at[1]));
    norms.add(1, x.p[k], exact.p(at[0] + 0.5 * h, at[1] + 0.5 * h));
  });
  out.errors = norms.of_all(comm);
  return out;
}

// Errors of the prototype that the specification quotes, within 5 %.
TEST(Stokes, SolCxWithAJumpOfTheViscosityOfAMillion) {
  const Solved a = solcx(64), b = solcx(128);
  EXPECT_TRUE(a.effort.converged && b.effort.converged);
  EXPECT_LE(a.effort.iterations, 18);
  EXPECT_LE(b.effort.iterations, 18);
  EXPECT_NEAR(b.effort.iterations, a.effort.iterations, 3);
  EXPECT_NEAR(a.errors[0], 4.3e-3, 0.05 * 4.3e-3);
  EXPECT_NEAR(a.errors[1], 3.2e-4, 0.05 * 3.2e-4);
  EXPECT_NEAR(b.errors[0], 1.07e-3, 0.05 * 1.07e-3);
  EXPECT_NEAR(b.errors[1], 7.9e-5, 0.05 * 7.9e-5);
}

// eta = exp(a.x), a solenoidal flow: f_i = -eta (2 eps_ij a_j + lap u_i) + d_i p.
Solved smooth(int dim, std::int64_t n) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  const Grid g = unit_box(dim, n, Side::free_slip);
  Solver solver(comm, g, even_boxes(g, comm.size()));
  const Patch& p = solver.patch();
  const double h = g.edge[0];
  const std::array<double, 3> a{2.0, -1.0, dim == 3 ? 3.0 : 0.0};
  const std::array<double, 3> amplitude{1, dim == 3 ? 1.0 : -1.0, -2};
  const auto d = static_cast<std::size_t>(dim);
  const auto wave = [&](const std::array<double, 3>& x, std::size_t odd, std::size_t odd2) {
    double product = 1;
    for (std::size_t b = 0; b < d; ++b)
      product *= (b == odd) != (b == odd2) ? std::sin(pi * x[b]) : std::cos(pi * x[b]);
    return product;
  };
  const std::size_t none = 9;
  const auto flow = [&](const std::array<double, 3>& x, std::size_t i) {
    return amplitude[i] * wave(x, i, none);
  };
  // d_j u_i
  const auto gradient = [&](const std::array<double, 3>& x, std::size_t i, std::size_t j) {
    return i == j ? pi * amplitude[i] * wave(x, none, none) : -pi * amplitude[i] * wave(x, i, j);
  };
  const auto viscosity = [&](const std::array<double, 3>& x) {
    return std::exp(a[0] * x[0] + a[1] * x[1] + a[2] * x[2]);
  };
  const auto centre = [&](std::array<double, 3> x, std::size_t face) {
    for (std::size_t b = 0; b < d; ++b)
      if (b != face) x[b] += 0.5 * h;
    return x;
  };
  Flow x = solver.make_flow();
  Velocity force = solver.make_flow().u;
  Field eta(p.size, 1.0);
  for_corners(p, [&](std::ptrdiff_t k, const std::array<double, 3>& corner) {
    eta[k] = viscosity(centre(corner, none));
    for (std::size_t i = 0; i < d; ++i) {
      const std::array<double, 3> at = centre(corner, i);
      double stress = -static_cast<double>(dim) * pi * pi * flow(at, i);
      for (std::size_t j = 0; j < d; ++j) stress += (gradient(at, i, j) + gradient(at, j, i)) * a[j];
      force[i][k] = -viscosity(at) * stress - pi * wave(at, i, none);
    }
  });
  solver.set_viscosity(eta);
  Solved out{solver.solve(force, x, 1e-9), {}};
  Norms norms;
  for_corners(p, [&](std::ptrdiff_t k, const std::array<double, 3>& corner) {
    for (std::size_t i = 0; i < d; ++i) norms.add(0, x.u[i][k], flow(centre(corner, i), i));
    norms.add(1, x.p[k], wave(centre(corner, none), none, none));
  });
  out.errors = norms.of_all(comm);
  return out;
}

TEST(Stokes, SmoothViscosityIsOfSecondOrder) {
  for (const int dim : {2, 3}) {
    const Solved coarse = smooth(dim, 16), fine = smooth(dim, 32);
    EXPECT_TRUE(coarse.effort.converged && fine.effort.converged);
    for (std::size_t k = 0; k < 2; ++k)
      EXPECT_GT(std::log2(coarse.errors[k] / fine.errors[k]), 1.85)
          << dim << "D " << k << ' ' << fine.errors[k];
    EXPECT_LT(fine.errors[0], 0.004);
  }
}

// Between walls that hold it, driven along a periodic axis: u = f / (2 eta) y (1 - y), exact but for the walls' h^2 / 8.
TEST(Stokes, FlowThroughAChannel) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  Grid g = unit_box(2, 32, Side::no_slip);
  g.sides[0] = {Side::periodic, Side::periodic};
  Solver solver(comm, g, even_boxes(g, comm.size()));
  const Patch& p = solver.patch();
  Flow x = solver.make_flow();
  Velocity force = solver.make_flow().u;
  for (double& f : force[0]) f = 8;
  solver.set_viscosity(Field(p.size, 1.0));
  EXPECT_TRUE(solver.solve(force, x, 1e-10).converged);
  for_corners(p, [&](std::ptrdiff_t k, const std::array<double, 3>& at) {
    const double y = at[1] + 0.5 * g.edge[1];
    EXPECT_NEAR(x.u[0][k], 4 * y * (1 - y) + g.edge[1] * g.edge[1], 1e-8);
    EXPECT_NEAR(x.u[1][k], 0, 1e-8);
  });
}

// A force that is a gradient moves nothing, and what drives a fluid that nothing holds is taken off.
TEST(Stokes, WhatPressureBalancesMovesNothing) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  const Grid g = unit_box(3, 16, Side::periodic);
  Solver solver(comm, g, even_boxes(g, comm.size()));
  const Patch& p = solver.patch();
  const double h = g.edge[0];
  Flow x = solver.make_flow();
  Velocity force = solver.make_flow().u;
  for_corners(p, [&](std::ptrdiff_t k, const std::array<double, 3>& at) {
    force[0][k] = 3.0;
    force[2][k] = (std::cos(2 * pi * (at[2] + 0.5 * h)) - std::cos(2 * pi * (at[2] - 0.5 * h))) / h;
  });
  solver.set_viscosity(Field(p.size, 1.0));
  EXPECT_TRUE(solver.solve(force, x, 1e-10).converged);
  for_corners(p, [&](std::ptrdiff_t k, const std::array<double, 3>& at) {
    for (const Field& u : x.u) EXPECT_NEAR(u[k], 0, 1e-9);
    EXPECT_NEAR(x.p[k], std::cos(2 * pi * (at[2] + 0.5 * h)), 1e-8);
  });
}

// Out of a sphere of sources a flow in all directions, on grids of two spacings; its divergence is what was asked for.
TEST(Stokes, FlowsOutOfSources) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  const Grid g = unit_box(2, 32, Side::free_slip);
  Solver solver(comm, g, even_boxes(g, comm.size()));
  const Patch& p = solver.patch();
  const double h = g.edge[0];
  Flow x = solver.make_flow();
  Field source(p.size, 0.0);
  // u = (cos(pi y) sin(pi x), cos(pi x) sin(pi y)) = -grad phi: what flows without a force, of a phi that is
  // harmonic but for the sources; their mean is 0.
  for_corners(p, [&](std::ptrdiff_t k, const std::array<double, 3>& at) {
    source[k] = 2 * pi * std::cos(pi * (at[0] + 0.5 * h)) * std::cos(pi * (at[1] + 0.5 * h)) + 7;
  });
  solver.set_viscosity(Field(p.size, 1e3));
  EXPECT_TRUE(solver.solve(solver.make_flow().u, x, 1e-10, 200, &source).converged);
  for_corners(p, [&](std::ptrdiff_t k, const std::array<double, 3>& at) {
    EXPECT_NEAR(x.u[0][k], std::sin(pi * at[0]) * std::cos(pi * (at[1] + 0.5 * h)), 1e-3);
    EXPECT_NEAR(x.u[1][k], std::sin(pi * at[1]) * std::cos(pi * (at[0] + 0.5 * h)), 1e-3);
  });
}

// Darcy's flow: where faces resist far more than shear does, each component is what drives it over the resistance.
TEST(Stokes, FacesResist) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  Grid g = unit_box(3, 16, Side::periodic);
  g.sides[2] = {Side::no_slip, Side::free_slip};
  Solver solver(comm, g, even_boxes(g, comm.size()));
  const Patch& p = solver.patch();
  Flow x = solver.make_flow();
  Velocity force = solver.make_flow().u;
  Resistance resistance{{true, false, false}, {Field(p.size, 0.0), {}, {}}};
  // u'' = (k u - f) / eta between a wall that holds it and one that does not.
  const double k = 30, f = 6, eta = 2, a = std::sqrt(k / eta);
  for_corners(p, [&](std::ptrdiff_t c, const std::array<double, 3>&) {
    force[0][c] = f;
    resistance.faces[0][c] = k;
  });
  solver.set_viscosity(Field(p.size, eta), resistance);
  const Effort effort = solver.solve(force, x, 1e-10);
  EXPECT_TRUE(effort.converged);
  EXPECT_LE(effort.iterations, 14);
  for_corners(p, [&](std::ptrdiff_t c, const std::array<double, 3>& at) {
    const double z = at[2] + 0.5 * g.edge[2];
    EXPECT_NEAR(x.u[0][c], f / k * (1 - std::cosh(a * (1 - z)) / std::cosh(a)), 0.01 * f / k);
    EXPECT_NEAR(x.u[1][c], 0, 1e-9);
  });
}

TEST(Stokes, BitsAreThoseOfOneRank) {
  const decomp::Comm world(MPI_COMM_WORLD), alone(MPI_COMM_SELF);
  for (const int dim : {2, 3})
    for (unsigned seed = 0; seed < 6; ++seed) {
      std::mt19937 random(seed);
      Grid g = unit_box(dim, dim == 2 ? 96 : 24, Side::free_slip);
      for (std::size_t a = 0; a < static_cast<std::size_t>(dim); ++a) {
        const auto side = static_cast<Side>(random() % 3), other = static_cast<Side>(1 + random() % 2);
        g.sides[a] = {side, side == Side::periodic ? side : other};
      }
      const auto run = [&](const decomp::Comm& comm, const std::vector<Box>& boxes) {
        Solver solver(comm, g, boxes);
        const Patch& p = solver.patch();
        Flow x = solver.make_flow();
        Velocity force = solver.make_flow().u;
        Field eta(p.size, 1.0), source(p.size, 0.0);
        Resistance resistance{{false, seed % 3 != 0, false}, {Field(), Field(p.size, 0.0), Field()}};
        for_corners(p, [&](std::ptrdiff_t k, const std::array<double, 3>& at) {
          eta[k] = at[0] + 0.3 * at[1] * at[1] < 0.6 ? 1 : 1e4;
          force[1][k] = at[0] * (1 - at[0]) * at[1];
          source[k] = 1e-6 * (at[0] - at[1]);
          resistance.faces[1][k] = at[1] < 0.4 ? 50 : 0;
        });
        solver.set_viscosity(eta, resistance);
        const Effort effort = solver.solve(force, x, 1e-6, 12, &source);
        return std::tuple(p, std::move(x), effort.iterations);
      };
      const auto [whole, expected, iterations] = run(alone, {g.box()});
      const auto boxes =
          seed % 2 == 0 ? even_boxes(g, world.size()) : random_boxes(g, 0, world.size(), random, tile);
      const auto [part, got, iterations_here] = run(world, boxes);
      EXPECT_EQ(iterations_here, iterations);
      std::size_t wrong = other_bits(part, got.p, whole, expected.p);
      for (std::size_t a = 0; a < static_cast<std::size_t>(dim); ++a)
        wrong += other_bits(part, got.u[a], whole, expected.u[a]);
      EXPECT_EQ(wrong, 0U) << dim << "D, seed " << seed;
    }
}

TEST(Stokes, GridsThatCannotBeHalvedOftenEnoughAreRefused) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  Grid g = unit_box(2, 64, Side::free_slip);
  g.cells[1] = 72;
  try {
    const Solver solver(comm, g, even_boxes(g, comm.size()));
    FAIL();
  } catch (const decomp::InputError& e) {
    EXPECT_NE(std::string(e.what()).find("64 x 72 cells, which can be halved to 8 x 9 only"),
              std::string::npos)
        << e.what();
  }
}

}  // namespace
