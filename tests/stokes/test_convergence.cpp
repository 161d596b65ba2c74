// A solver that says that it has converged has, and one that has not says so: the residual is found again from the parts
// of the operator.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

#include "stokes/fields.hpp"
#include "stokes/partition.hpp"
#include "stokes/solver.hpp"

namespace {

using namespace stokes;
using namespace test_stokes;

struct Problem {
  Field viscosity;
  Resistance resistance;
  Velocity force;
  Field source;
};

void take_off_mean(const decomp::Comm& comm, const Patch& p, Field& f) {
  const double mean = sum_over_cells(comm, p, [&](std::ptrdiff_t k) { return f[k]; }) * p.grid.volume();
  for (double& v : f) v -= mean;
}

double norm(const decomp::Comm& comm, const Patch& p, const Flow& r, double weight) {
  return std::sqrt(sum_over_cells(comm, p, [&](std::ptrdiff_t k) {
    double square = weight * weight * r.p[k] * r.p[k];
    for (std::size_t a = 0; a < static_cast<std::size_t>(p.grid.dim); ++a) square += r.u[a][k] * r.u[a][k];
    return square;
  }));
}

/// |f - K x| / |f| in a box of unit size.
double residual(const decomp::Comm& comm, const Solver& solver, const Problem& problem, Flow x) {
  const Grid& g = solver.patch().grid;
  Level level(comm, g, even_boxes(g, comm.size()));
  const Patch& p = level.patch();
  Field cells = problem.viscosity;
  level.refresh_cells(cells);
  level.set_viscosity(cells, EdgeMean::harmonic, problem.resistance);
  Flow f = solver.make_flow(), r = f;
  f.u = problem.force;
  for_own(p, [&](std::ptrdiff_t k) { f.p[k] = -problem.source[k]; });
  take_off_mean(comm, p, f.p);
  for (int a = 0; a < g.dim; ++a)
    if (g.slides(a)) take_off_mean(comm, p, f.u[static_cast<std::size_t>(a)]);
  add_gradient(p, f.p, 0, f.u);
  level.refresh_cells(x.p);
  Velocity without_pressure = f.u;
  add_gradient(p, x.p, -1, without_pressure);
  r.u = level.residual(without_pressure, x.u);
  for (int a = 0; a < g.dim; ++a)
    if (g.slides(a)) take_off_mean(comm, p, r.u[static_cast<std::size_t>(a)]);
  minus_divergence(p, x.u, r.p);
  for_own(p, [&](std::ptrdiff_t k) { r.p[k] = f.p[k] - r.p[k]; });
  std::array<double, 1> fluidity{0};
  for_own(p, [&](std::ptrdiff_t k) { fluidity[0] = std::max(fluidity[0], 1 / problem.viscosity[k]); });
  comm.max(fluidity);
  const double weight = 1 / (fluidity[0] * g.edge[0]);
  return norm(comm, p, r, weight) / norm(comm, p, f, weight);
}

Problem nothing(const Solver& solver) {
  const std::size_t n = solver.patch().size;
  return {Field(n, 1.0), {}, solver.make_flow().u, Field(n, 0.0)};
}

/// Eight stiff heavy discs of three cells in radius, which the coarse grids do not see.
Problem discs(const Solver& solver, double contrast) {
  Problem problem = nothing(solver);
  const Patch& p = solver.patch();
  const auto up = static_cast<std::size_t>(p.grid.dim - 1);
  for_cells(p, [&](std::ptrdiff_t k, const Int3& x) {
    for (int disc = 0; disc < 8; ++disc) {
      double square = std::pow(static_cast<double>(x[0]) - (8 * disc + 3.5), 2);
      square += std::pow(static_cast<double>(x[up]) - (disc * 29 % 48 + 7.5), 2);
      if (square >= 9) continue;
      problem.viscosity[k] = contrast;
      problem.force[up][k] = -1;
    }
  });
  return problem;
}

// One V-cycle an iteration is too slow for the sharpest of them, which shows in 40.
TEST(StokesConvergence, OfManySharpDiscsTakesMoreVCycles) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  for (const auto& [side, contrast] : {std::pair(Side::free_slip, 1e2), std::pair(Side::free_slip, 1e4),
                                       std::pair(Side::free_slip, 1e6), std::pair(Side::periodic, 1e6)}) {
    const Grid g = unit_box(2, 64, side);
    Solver solver(comm, g, even_boxes(g, comm.size()));
    const Problem problem = discs(solver, contrast);
    solver.set_viscosity(problem.viscosity);
    for (const int most : {25, 80}) {
      Flow x = solver.make_flow();
      const Effort effort = solver.solve(problem.force, x, 1e-6, most);
      const double left = residual(comm, solver, problem, x);
      EXPECT_NEAR(effort.residual, left, 1e-4 * left) << contrast;
      EXPECT_EQ(effort.converged, most > 40) << contrast << ' ' << effort.residual;
      EXPECT_EQ(effort.converged, left <= 1e-6) << contrast;
      EXPECT_EQ(effort.cycles > effort.iterations, contrast > 1e3 && most > 40) << contrast;
      EXPECT_LE(effort.cycles, 1000) << contrast;
    }
  }
}

TEST(StokesConvergence, OfManySharpDiscsHasTheBitsOfOneRank) {
  const decomp::Comm world(MPI_COMM_WORLD), alone(MPI_COMM_SELF);
  const Grid g = unit_box(2, 64, Side::free_slip);
  std::mt19937 random(1);
  const auto run = [&](const decomp::Comm& comm, const std::vector<Box>& boxes) {
    Solver solver(comm, g, boxes);
    const Problem problem = discs(solver, 1e4);
    solver.set_viscosity(problem.viscosity);
    Flow x = solver.make_flow();
    const Effort effort = solver.solve(problem.force, x, 1e-6, 45);
    return std::tuple(solver.patch(), std::move(x), effort);
  };
  const auto [whole, expected, effort] = run(alone, {g.box()});
  EXPECT_GT(effort.cycles, effort.iterations);
  const auto [part, got, effort_here] = run(world, random_boxes(g, 1, world.size(), random, tile));
  EXPECT_EQ(effort_here.cycles, effort.cycles);
  EXPECT_EQ(other_bits(part, got.p, whole, expected.p), 0U);
  for (std::size_t a = 0; a < 2; ++a) EXPECT_EQ(other_bits(part, got.u[a], whole, expected.u[a]), 0U);
}

TEST(StokesConvergence, IsThatOfWhatIsReturned) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  int slide = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    std::mt19937 random(seed);
    const int dim = seed % 4 == 0 ? 3 : 2;
    Grid g = unit_box(dim, dim == 2 ? 32 : 16, Side::free_slip);
    for (std::size_t a = 0; a < static_cast<std::size_t>(dim); ++a) {
      const auto side = static_cast<Side>(random() % 3), other = static_cast<Side>(1 + random() % 2);
      g.sides[a] = {side, side == Side::periodic ? side : other};
    }
    if (seed % 3 == 0) g.sides[0].fill(Side::free_slip), g.sides[1].fill(Side::periodic);
    Solver solver(comm, g, even_boxes(g, comm.size()));
    const Patch& p = solver.patch();
    Problem problem = nothing(solver);
    problem.viscosity = hashed_field(p, seed, 5, 4);
    problem.force = hashed_velocity(p, seed, 3);
    problem.source = hashed_field(p, seed + 1, 0, 0.1);
    if (seed % 2 == 0) {
      problem.resistance.along[1] = true;
      problem.resistance.faces[1] = hashed_field(p, seed + 2, 50, 50);
      slide += g.slides(1) ? 1 : 0;
    }
    solver.set_viscosity(problem.viscosity, problem.resistance);
    Flow x{hashed_velocity(p, seed + 3, 1), hashed_field(p, seed + 4, 0, 1)};
    for (const int most : {2, 100}) {
      const Effort effort = solver.solve(problem.force, x, 1e-7, most, &problem.source);
      const double left = residual(comm, solver, problem, x);
      EXPECT_NEAR(effort.residual, left, 1e-6 * left + 1e-12) << seed;
      EXPECT_EQ(effort.converged, left <= 1e-7) << seed;
      EXPECT_EQ(effort.converged, most > 2) << seed;
    }
  }
  EXPECT_GT(slide, 3);
}

TEST(StokesConvergence, WhatIsNoNumberEnds) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  const Grid g = unit_box(2, 16, Side::free_slip);
  Solver solver(comm, g, even_boxes(g, comm.size()));
  for (const double wrong :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Problem problem = nothing(solver);
    for_cells(solver.patch(), [&](std::ptrdiff_t k, const Int3& x) {
      if (x == Int3{3, 5, 0}) problem.force[1][k] = wrong;
    });
    solver.set_viscosity(problem.viscosity);
    Flow x = solver.make_flow();
    const Effort effort = solver.solve(problem.force, x, 1e-6);
    EXPECT_FALSE(effort.converged);
    EXPECT_FALSE(std::isfinite(effort.residual));
  }
  Problem problem = nothing(solver);
  solver.set_viscosity(problem.viscosity);
  Flow at_rest = solver.make_flow(), moving{hashed_velocity(solver.patch(), 1, 1), at_rest.p};
  EXPECT_TRUE(solver.solve(problem.force, at_rest, 1e-6).converged);
  const Effort effort = solver.solve(problem.force, moving, 1e-6, 5);  // towards a tolerance of 0
  EXPECT_FALSE(effort.converged);
  EXPECT_GT(effort.residual, 1);
}

}  // namespace
