// Drag on a simple cubic lattice of rigid spheres of radius a and volume fraction c (Hasimoto 1959):
//   6 pi eta a U / F = 1 - 1.7601 c^(1/3) + c - 1.5593 c^2,
// U the sphere's velocity against the mean of the whole, F the pull on each, which the mean pressure gradient balances.
// The rigid sphere is one of a high viscosity, in which the pull is a body force; the solver takes its mean off.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "stokes/fields.hpp"
#include "stokes/partition.hpp"
#include "stokes/solver.hpp"

namespace {

using namespace stokes;
using namespace test_stokes;

struct Sphere {
  Effort effort;
  double mobility;  ///< 6 pi eta a U / F
};

/// One of radius 1/4 in a box of n cells a side.
Sphere sphere(std::int64_t n, double viscosity) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  const Grid g = unit_box(3, n, Side::periodic);
  Solver solver(comm, g, even_boxes(g, comm.size()));
  const Patch& p = solver.patch();
  const double radius = 0.25;
  Flow x = solver.make_flow();
  Velocity force = solver.make_flow().u;
  Field inside(p.size, 0.0), eta(p.size, 1.0);
  for_corners(p, [&](std::ptrdiff_t k, const std::array<double, 3>& at) {
    double r2 = 0;
    for (const double c : at) r2 += (c + 0.5 * g.edge[0] - 0.5) * (c + 0.5 * g.edge[0] - 0.5);
    inside[k] = r2 < radius * radius ? 1 : 0;
    eta[k] = inside[k] > 0 ? viscosity : 1;
  });
  solver.refresh(inside);
  const std::ptrdiff_t below = p.stride[2];
  for_own(p, [&](std::ptrdiff_t k) { force[2][k] = 0.5 * (inside[k] + inside[k - below]); });
  solver.set_viscosity(eta);
  const Effort effort = solver.solve(force, x, 1e-6);
  // The power of the pull is U F: weights of faces are those of the pull.
  const double power = sum_over_cells(comm, p, [&](std::ptrdiff_t k) { return force[2][k] * x.u[2][k]; });
  const double cells = sum_over_cells(comm, p, [&](std::ptrdiff_t k) { return inside[k]; });
  const double pull = cells * g.volume();
  return {effort, 6 * std::numbers::pi * radius * (power / cells) / pull};
}

TEST(StokesCases, DragOnALatticeOfSpheres) {
  const double c = 4.0 / 3 * std::numbers::pi / 64;
  const double hasimoto = 1 - 1.7601 * std::cbrt(c) + c - 1.5593 * c * c;
  for (const double viscosity : {1e3, 1e4}) {
    const Sphere s = sphere(32, viscosity);
    EXPECT_TRUE(s.effort.converged);
    EXPECT_LE(s.effort.iterations, viscosity > 1e3 ? 28 : 25);
    EXPECT_NEAR(s.mobility, hasimoto, 0.03 * hasimoto) << viscosity;
  }
}

}  // namespace
