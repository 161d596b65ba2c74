// A flow of melts on many ranks, and beside real ones: messages and bytes are counted where MPI is called.
#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "../timing.hpp"
#include "commands.hpp"
#include "flow_traffic.hpp"
#include "stokes/solver.hpp"

namespace {

struct Counted {
  double messages = 0, bytes = 0, reductions = 0, reduced = 0;
} counted;

}  // namespace

// MPI's profiling interface: the names that the library calls.
extern "C" int MPI_Isend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm,
                         MPI_Request* request) {
  int size = 0;
  MPI_Type_size(type, &size);
  ++counted.messages;
  counted.bytes += static_cast<double>(count) * size;
  return PMPI_Isend(data, count, type, to, tag, comm, request);
}
extern "C" int MPI_Allreduce(const void* from, void* to, int count, MPI_Datatype type, MPI_Op op,
                             MPI_Comm comm) {
  int size = 0, ranks = 0;
  MPI_Type_size(type, &size);
  MPI_Comm_size(comm, &ranks);
  int world = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &world);
  if (ranks == world) {  // not those that a rank does by itself
    ++counted.reductions;
    counted.reduced += static_cast<double>(count) * size;
  }
  return PMPI_Allreduce(from, to, count, type, op, comm);
}

namespace scale_sim {
namespace {

stokes::Grid walls(const decomp::Int3& cells) {
  stokes::Grid grid;
  grid.dim = 3;
  grid.cells = cells;
  for (std::size_t a = 0; a < 3; ++a) grid.sides[a].fill(stokes::Side::free_slip);
  return grid;
}

/// CPU seconds of this rank in one flow: a heavy half over a light one, a hundred times as stiff.
double flow(const decomp::Comm& comm, const stokes::Grid& grid, int iterations) {
  stokes::Solver solver(comm, grid, stokes::even_boxes(grid, comm.size()));
  const stokes::Patch& p = solver.patch();
  stokes::Flow x = solver.make_flow();
  stokes::Velocity force = solver.make_flow().u;
  stokes::Field eta(p.size, 1.0);
  stokes::for_lines(p, [&](std::ptrdiff_t first, std::int64_t n, std::int64_t y, std::int64_t z) {
    for (std::int64_t i = 0; i < n; ++i) {
      const bool above = 2 * z > grid.cells[2] + (y + p.own.lo[0] + i) % 5;
      eta[static_cast<std::size_t>(first + i)] = above ? 100 : 1;
      if (z > 0) force[2][static_cast<std::size_t>(first + i)] = above ? -1 : 0;
    }
  });
  MPI_Barrier(MPI_COMM_WORLD);
  counted = {};
  const double start = cpu_seconds();
  solver.set_viscosity(std::move(eta));
  const stokes::Effort effort = solver.solve(std::move(force), x, 1e-30, iterations);
  if (effort.iterations != iterations) throw std::runtime_error("the solver ended early");
  return cpu_seconds() - start;
}

/// CPU seconds of a flow over cells and iterations, measured: a + b n + c n^2.
struct FlowCost {
  double fixed = 0, iteration = 0, products = 0;
  [[nodiscard]] double of(double n) const { return fixed + n * (iteration + n * products); }
};
FlowCost measure(const decomp::Comm& comm, const stokes::Grid& grid) {
  const double cells = static_cast<double>(decomp::cell_count(grid.box()));
  std::array<double, 3> t{}, n{4, 8, 16};
  for (std::size_t k = 0; k < 3; ++k) {
    std::vector<double> repeated;
    for (int r = 0; r < 3; ++r) repeated.push_back(flow(comm, grid, static_cast<int>(n[k])));
    t[k] = median(repeated) / cells;
  }
  const double first = (t[1] - t[0]) / (n[1] - n[0]), second = (t[2] - t[1]) / (n[2] - n[1]);
  FlowCost out;
  out.products = (second - first) / (n[2] - n[0]);
  out.iteration = first - out.products * (n[0] + n[1]);
  out.fixed = t[0] - n[0] * (out.iteration + n[0] * out.products);
  return out;
}

/// The smallest grid of as many cells up as 1.5 times across with at least so many columns of 8 x 8 a rank.
stokes::Grid grid_for(int ranks, double tiles) {
  decomp::Int3 cells{32, 32, 48};
  while (static_cast<double>(cells[0] * cells[1]) < 64 * tiles * ranks)
    for (std::int64_t& c : cells) c *= 2;
  return walls(cells);
}

void predict(const FlowPrediction& o, const FlowCost& cost, int ranks, const stokes::Grid& grid) {
  const FlowTraffic t = flow_traffic(grid, ranks, o.iterations, 200);
  double to_all = 0, halos = 0, coarse = 0, cells = 0;
  for (const Exchanged& e : t.exchanges) {
    const double seconds =
        e.times * e.largest.messages * o.network.latency + e.bytes * e.largest.cells / o.network.bandwidth;
    (e.to_all ? to_all : e.level == 0 ? halos : coarse) += seconds;
  }
  for (const double c : t.cells) cells += c;
  const double compute = cost.of(o.iterations) * t.cells[0];
  // Coarse grids cost what their cells do, an eighth of them in each if evenly cut.
  const double uneven = cost.of(o.iterations) * (7.0 / 8) * std::max(0.0, cells - t.cells[0] * 8 / 7);
  const double rounds = static_cast<double>(std::bit_width(static_cast<unsigned>(ranks - 1)));
  const double reduce =
      rounds * (2 * t.reduced.times * o.network.latency + t.reduced.bytes / o.network.bandwidth);
  const double total = compute + uneven + halos + coarse + to_all + reduce;
  const double even = cost.of(o.iterations) * static_cast<double>(decomp::cell_count(grid.box())) / ranks;
  fmt::print(
      "{:7} {:>16} {:9.3g} {:8.2f} {:9.3f} {:9.3f} {:8.4f} {:8.4f} {:9.4f} {:8.4f} {:9.3f} {:10.3f} {:9.1f} "
      "ms\n",
      ranks, fmt::format("{}^2 x {}", grid.cells[0], grid.cells[2]), t.cells[0],
      t.cells[0] * ranks / static_cast<double>(decomp::cell_count(grid.box())), compute, uneven, halos,
      coarse, to_all, reduce, total, even / total, 1e3 * t.search);
  std::fflush(stdout);
}

void check(const decomp::Comm& comm, const FlowPrediction& o, const stokes::Grid& grid) {
  const double own = flow(comm, grid, o.iterations);
  const Counted here = counted;
  std::array<std::int64_t, 2> sent{static_cast<std::int64_t>(here.messages),
                                   static_cast<std::int64_t>(here.bytes)};
  comm.sum(std::span(sent));
  double cpu = 0;
  for (const double t : comm.all_gather(own)) cpu += t;
  if (comm.rank() != 0) return;
  const FlowTraffic t = flow_traffic(grid, comm.size(), o.iterations, comm.size());
  fmt::print(
      "ranks {} messages {:.0f} measured {} bytes {:.0f} measured {} reductions {:.0f} measured {:.0f} "
      "reduced bytes {:.0f} measured {:.0f} CPU {:.3f} s, {:.1f} ns a cell and iteration\n",
      comm.size(), t.messages(), sent[0], t.bytes(), sent[1], t.reduced.times, here.reductions,
      t.reduced.bytes, here.reduced, cpu,
      1e9 * cpu / static_cast<double>(decomp::cell_count(grid.box())) / o.iterations);
}

}  // namespace

void predict_flow(const FlowPrediction& o) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  const stokes::Grid grid = walls({o.cells, o.cells, o.cells / 2 * 3});
  if (o.check) return check(comm, o, grid);
  const FlowCost cost = measure(comm, grid);
  fmt::print(
      "{:.0f} ns a cell, {:.0f} an iteration and {:.1f} its square, measured on {} cells; {} iterations\n"
      "  ranks            cells  of a rank  uneven  compute s  coarse s   halos    coarse  to everyone  "
      "reduce    total s  efficiency  search\n",
      1e9 * cost.fixed, 1e9 * cost.iteration, 1e9 * cost.products, decomp::cell_count(grid.box()),
      o.iterations);
  for (const int ranks : o.ranks) predict(o, cost, ranks, grid_for(ranks, o.tiles));
  fmt::print("\nthe grid of the most ranks on fewer\n");
  const stokes::Grid one = grid_for(*std::ranges::max_element(o.ranks), o.tiles);
  for (const int ranks : o.ranks) predict(o, cost, ranks, one);
}

}  // namespace scale_sim
