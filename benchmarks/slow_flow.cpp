// Seconds of the solver of slow flow, set-up included, for two problems that PETSc's examples pose too (stokes.py).
#include <fmt/format.h>
#include <mpi.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "decomp/exact_sum.hpp"
#include "program.hpp"
#include "stokes/partition.hpp"
#include "stokes/solver.hpp"
#include "timing.hpp"

namespace {

using Place = std::array<double, 3>;

/// In a unit box with free slip.
struct Problem {
  int dim;
  std::size_t up;  ///< the axis of the force
  std::function<double(const Place&)> viscosity, force;
};

/// ex43's -c_str 0.
Problem solcx(double contrast) {
  using std::numbers::pi;
  return {2, 1, [=](const Place& x) { return x[0] > 0.5 ? contrast : 1; },
          [](const Place& x) { return std::sin(pi * x[1]) * std::cos(pi * x[0]); }};
}
/// ex42's -model 3: a stiff heavy cube.
Problem sinker() {
  const auto inside = [](const Place& x) {
    return std::fabs(x[0] - 0.5) < 0.2 && std::fabs(x[1] - 0.5) < 0.2 && std::fabs(x[2] - 0.5) < 0.2;
  };
  return {3, 2, [=](const Place& x) { return inside(x) ? 1 : 0.01; },
          [=](const Place& x) { return inside(x) ? 1 : 0; }};
}

/// Means over the points of Gauss of each cell, which is all that finite elements know of it.
stokes::Field means(const stokes::Patch& p, const std::function<double(const Place&)>& value) {
  stokes::Field out(p.size, 1.0);
  const int dim = p.grid.dim, points = 1 << dim;
  const double apart = 0.5 / std::sqrt(3.0);
  stokes::for_lines(p, [&](std::ptrdiff_t first, std::int64_t n, std::int64_t y, std::int64_t z) {
    for (std::int64_t i = 0; i < n; ++i) {
      const std::array cell{p.own.lo[0] + i, y, z};
      double sum = 0;
      for (int point = 0; point < points; ++point) {
        Place x{};
        for (std::size_t a = 0; a < static_cast<std::size_t>(dim); ++a)
          x[a] = (static_cast<double>(cell[a]) + 0.5 + ((point >> a & 1) != 0 ? apart : -apart)) *
                 p.grid.edge[a];
        sum += value(x);
      }
      out[first + i] = sum / points;
    }
  });
  return out;
}

/// Between two points of time, on the slowest rank.
class Clock {
 public:
  explicit Clock(const decomp::Comm& comm) : comm_(comm), last_(MPI_Wtime()) {}
  double lap() {
    std::array now{MPI_Wtime()};
    comm_.max(now);
    const double seconds = now[0] - last_;
    last_ = now[0];
    return seconds;
  }

 private:
  const decomp::Comm& comm_;
  double last_;
};

struct Times {
  std::vector<double> set_up, solve;
  stokes::Effort effort;
  double rms_speed = 0;
};

void measure(const decomp::Comm& comm, const Problem& problem, const stokes::Grid& grid, double tolerance,
             Times& times) {
  MPI_Barrier(MPI_COMM_WORLD);
  Clock clock(comm);
  stokes::Solver solver(comm, grid, stokes::even_boxes(grid, comm.size()));
  const stokes::Patch& p = solver.patch();
  stokes::Field weight = means(p, problem.force);
  solver.refresh(weight);
  stokes::Flow x = solver.make_flow();
  stokes::Velocity force = solver.make_flow().u;
  const std::ptrdiff_t below = p.stride[problem.up];
  stokes::for_own(p, [&](std::ptrdiff_t k) { force[problem.up][k] = 0.5 * (weight[k] + weight[k - below]); });
  solver.set_viscosity(means(p, problem.viscosity));
  times.set_up.push_back(clock.lap());
  times.effort = solver.solve(std::move(force), x, tolerance);
  times.solve.push_back(clock.lap());
  std::array<decomp::ExactSum, 1> square;
  for (std::size_t a = 0; a < static_cast<std::size_t>(grid.dim); ++a)
    stokes::for_own(p, [&](std::ptrdiff_t k) { square[0].add(x.u[a][k] * x.u[a][k]); });
  decomp::ExactSum::all_reduce(comm, square);
  times.rms_speed = std::sqrt(square[0].value() * grid.volume());
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Speed of the solver of slow flow: SolCx in 2D, a sinking cube in 3D", "slow_flow");
  int dim = 2, cells = 64, repeats = 5;
  double contrast = 1e6, tolerance = 1e-6;
  app.add_option("--dimension", dim, "2: SolCx, 3: a sinking cube, a hundred times as stiff")
      ->check(CLI::Range(2, 3));
  app.add_option("--cells", cells, "along each axis")->check(CLI::Range(8, 4096));
  app.add_option("--contrast", contrast, "of the viscosities of SolCx")->check(CLI::PositiveNumber);
  app.add_option("--tolerance", tolerance, "of the residual, relative")->check(CLI::PositiveNumber);
  app.add_option("--repeats", repeats, "medians of so many")->check(CLI::Range(1, 1000));
  if (const auto code = parse(app, argc, argv)) return *code;
  return run_under_mpi(app, argc, argv, [&] {
    const decomp::Comm comm(MPI_COMM_WORLD);
    const Problem problem = dim == 2 ? solcx(contrast) : sinker();
    stokes::Grid grid;
    grid.dim = dim;
    double unknowns = dim + 1;
    for (std::size_t a = 0; a < static_cast<std::size_t>(dim); ++a) {
      grid.cells[a] = cells;
      grid.edge[a] = 1.0 / cells;
      grid.sides[a].fill(stokes::Side::free_slip);
      unknowns *= cells;
    }
    Times times;
    for (int r = 0; r < repeats; ++r) measure(comm, problem, grid, tolerance, times);
    const double solve = median(times.solve), iterations = times.effort.iterations;
    if (comm.rank() == 0)
      fmt::print(
          "set-up {:.6f} s, solve {:.6f} s, {} iterations to {:.3g}{}, rms speed {:.6g}, "
          "{:.1f} ns per unknown and iteration\n",
          median(times.set_up), solve, times.effort.iterations, times.effort.residual,
          times.effort.converged ? "" : " (not converged)", times.rms_speed,
          1e9 * solve / (unknowns * iterations));
  });
}
