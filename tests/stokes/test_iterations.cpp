// How many iterations what the solver is made for takes, on grids of any width: a number that grows is a fault of the
// multigrid that no bit shows.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "stokes/fields.hpp"
#include "stokes/partition.hpp"
#include "stokes/solver.hpp"

namespace {

using namespace stokes;
using namespace test_stokes;
using std::numbers::pi;

using Place = std::array<double, 3>;

/// Viscosity of a place, its share of the heavy fluid, the width of a cell given.
struct Layers {
  std::function<double(const Place&, double)> viscosity, heavy;
};

Effort effort_of(int dim, std::int64_t n, Side side, const Layers& layers) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  const Grid g = unit_box(dim, n, side);
  Solver solver(comm, g, even_boxes(g, comm.size()));
  const Patch& p = solver.patch();
  const double h = g.edge[0];
  const auto up = static_cast<std::size_t>(dim - 1);
  Flow x = solver.make_flow();
  Velocity force = solver.make_flow().u;
  Field eta(p.size, 1.0);
  for_corners(p, [&](std::ptrdiff_t k, const Place& corner) {
    Place centre{corner[0] + 0.5 * h, corner[1] + 0.5 * h, dim == 3 ? corner[2] + 0.5 * h : 0.0};
    eta[k] = layers.viscosity(centre, h);
    centre[up] = corner[up];
    force[up][k] = -layers.heavy(centre, h);
  });
  solver.set_viscosity(eta);
  return solver.solve(force, x, 1e-6);
}

/// How high above an interface with a wave.
double above(const Place& x, int dim) {
  return x[static_cast<std::size_t>(dim - 1)] - 0.5 -
         0.1 * std::cos(2 * pi * x[0]) * (dim == 3 ? std::cos(2 * pi * x[1]) : 1.0);
}

Layers sharp(int dim, double contrast) {
  return {[=](const Place& x, double) { return above(x, dim) > 0 ? contrast : 1; },
          [=](const Place& x, double) { return above(x, dim) > 0 ? 1 : 0; }};
}
/// Over three cells, ln eta linear in the share.
Layers mixed(int dim, double contrast) {
  const auto heavy = [=](const Place& x, double h) {
    return std::clamp(0.5 + above(x, dim) / (3 * h), 0.0, 1.0);
  };
  return {[=](const Place& x, double h) { return std::pow(contrast, heavy(x, h)); }, heavy};
}
/// SolCx (solcx.hpp), in 3D too.
Layers solcx(int dim, double contrast) {
  return {[=](const Place& x, double) { return x[0] < 0.5 ? 1 : contrast; },
          [=](const Place& x, double) {
            return std::sin(pi * x[static_cast<std::size_t>(dim - 1)]) * std::cos(pi * x[0]);
          }};
}

struct Case {
  const char* name;
  Layers layers;
  int most;                       ///< asked for
  std::vector<int> pinned, held;  ///< of 32, 64, ... cells a side, walls that slip and that do not
};

void expect(int dim, const Case& c, Side side, const std::vector<int>& pinned) {
  std::int64_t n = 32;
  for (const int iterations : pinned) {
    const Effort effort = effort_of(dim, n, side, c.layers);
    EXPECT_TRUE(effort.converged);
    EXPECT_LE(effort.iterations, c.most) << c.name << ' ' << n;
    EXPECT_NEAR(effort.iterations, iterations, 1) << c.name << ' ' << n;
    n *= 2;
  }
}

// +-3 from 32 to 256 cells.
TEST(StokesIterations, AreFewOnAnyGrid) {
  for (const Case& c : {Case{"SolCx, 1e6", solcx(2, 1e6), 15, {13, 13, 13, 13}, {}},
                        Case{"mixed, 1e4", mixed(2, 1e4), 20, {11, 11, 12, 13}, {16, 17, 18}},
                        Case{"sharp, 1e2", sharp(2, 1e2), 35, {14, 15, 16, 18}, {19, 21, 23}},
                        Case{"sharp, 1e4", sharp(2, 1e4), 35, {12, 14, 16, 16}, {17, 19, 22}},
                        Case{"sharp, 1e6", sharp(2, 1e6), 35, {13, 15, 15, 16}, {19, 20, 20}}}) {
    expect(2, c, Side::free_slip, c.pinned);
    expect(2, c, Side::no_slip, c.held);
  }
  for (const Case& c :
       {Case{"SolCx, 1e6", solcx(3, 1e6), 15, {14}, {}}, Case{"mixed, 1e4", mixed(3, 1e4), 24, {13}, {21}},
        Case{"sharp, 1e4", sharp(3, 1e4), 35, {16}, {23}}}) {
    expect(3, c, Side::free_slip, c.pinned);
    expect(3, c, Side::no_slip, c.held);
  }
}

}  // namespace
