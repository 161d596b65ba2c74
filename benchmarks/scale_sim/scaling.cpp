// Weak and strong scaling by the model, with the real partition and balancer: what they take in memory and
// time is measured.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>
#include <set>

#include "allocated.hpp"
#include "commands.hpp"
#include "cost_fields.hpp"
#include "decomp/cut_policy.hpp"
#include "decomp/migrate.hpp"

namespace scale_sim {
namespace {

using namespace decomp;

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

constexpr double columns_at_most = 2e6;  // that a balancer looks at
constexpr double noise = 0.02;           // of a measured time, relative

std::vector<double> flat(std::int64_t rows, std::int64_t columns) {
  return fields::sampled(rows, columns, [](double, double) { return 1.0; });
}

/// Grains a cell of a settled bed (0.61 of the space, cells of 1.24 d), and cells in the depth of the
/// sandbox.
constexpr double packed = 2.2, sandbox_depth = 15;

const Domain sandbox{"sandbox wedge, 19 d deep", fields::wedge, 2, packed, sandbox_depth};
const Domain cube{"cube", flat, 1, packed, 0};

struct Grid {
  CellColumns columns;
  double per_column;  ///< particles, mean
};

Grid grid_of(const Domain& domain, double particles) {
  const double cells = particles / domain.per_cell;
  const double side = domain.depth > 0 ? std::sqrt(cells / domain.depth / domain.aspect) : std::cbrt(cells);
  Grid grid{{static_cast<std::int64_t>(side), static_cast<std::int64_t>(domain.aspect * side)}, 0};
  grid.columns.edge = std::max<std::int64_t>(
      1, static_cast<std::int64_t>(std::ceil(
             std::sqrt(static_cast<double>(grid.columns.rows * grid.columns.columns) / columns_at_most))));
  grid.per_column = particles / static_cast<double>(grid.columns.rows * grid.columns.columns);
  return grid;
}

CellCosts particles_of(const Domain& domain, CellColumns columns, double particles) {
  const std::int64_t rows = columns.coarse(columns.rows), across = columns.coarse(columns.columns);
  std::vector<double> field = domain.field(rows, across);
  double sum = 0;
  for (std::int64_t r = 0; r < rows; ++r)
    for (std::int64_t c = 0; c < across; ++c) {  // the last ones of a line may be cut short
      double& f = field[static_cast<std::size_t>(r * across + c)];
      f *= static_cast<double>(std::min(columns.edge, columns.rows - r * columns.edge) *
                               std::min(columns.edge, columns.columns - c * columns.edge));
      sum += f;
    }
  for (double& f : field) f *= particles / sum;
  return {columns, field};
}

/// What one rank of many holds and takes for the partition itself.
struct Burden {
  double decide = 0;              ///< seconds of a decision of the balancer
  double held = 0, deciding = 0;  ///< bytes: cuts of all ranks; at most, while deciding
  double neighbours = 0,
         peers = 0;    ///< ranks that share a halo, or may migrate here: mean of those looked at
  double look = 0;     ///< seconds to find both
  double blurred = 0;  ///< error of a part's cost by taking cells as one, largest
};

/// The balancer in its steady state: from the best cuts, a few calls with noisy times.
Cuts settle(const CellCosts& costs, int ranks, Burden& burden) {
  Cuts cuts = best_cuts(costs, jagged_shape(ranks, costs.rows(), costs.columns()));
  const auto policy = make_hybrid();
  std::mt19937 bits(1);
  std::normal_distribution<double> normal;
  const int calls = ranks > 20000 ? 2 : 5;
  for (int n = 0; n < calls; ++n) {
    std::vector<double> measured = part_costs(costs, cuts);
    for (double& t : measured) t *= 1 + noise * normal(bits);
    allocated::restart_peak();
    const std::size_t before = allocated::now();
    const auto start = Clock::now();
    cuts = policy->next(cuts, {measured, {&costs, 1}}, {costs.rows(), costs.columns()});
    burden.decide = seconds_since(start);
    burden.deciding = static_cast<double>(allocated::peak() - before);
  }
  return cuts;
}

void look_around(const CellCosts& costs, const Cuts& cuts, Burden& burden) {
  const CellGrid grid(2, {}, {costs.rows(), costs.columns(), 0}, {}, 1);
  const std::size_t before = allocated::now();
  const JaggedPartition partition(grid, 0, 1, cuts);
  burden.held = static_cast<double>(allocated::now() - before);
  const int looked_at = std::min(partition.ranks(), 1000);
  const auto start = Clock::now();
  for (int k = 0; k < looked_at; ++k) {
    const Rank r = static_cast<Rank>(static_cast<std::int64_t>(k) * partition.ranks() / looked_at);
    std::set<Rank> around;
    for (const auto& image : partition.neighbours(r, 1)) around.insert(image.rank);
    burden.neighbours += static_cast<double>(around.size()) / looked_at;
    burden.peers += static_cast<double>(migration_peers(partition, partition, r, 1).to.size()) / looked_at;
  }
  burden.look = seconds_since(start) / looked_at;
}

struct Case {
  Step step;
  Burden burden;
  double cells;  ///< along the edges of a rank's box, geometric mean
};

Case run(const Domain& domain, double particles, int ranks, const Code& code, const Network& network) {
  const Grid grid = grid_of(domain, particles);
  const CellCosts costs = particles_of(domain, grid.columns, particles);
  Case out;
  const Cuts cuts = settle(costs, ranks, out.burden);
  look_around(costs, cuts, out.burden);
  const Layout layout{};
  out.step = predict(costs, cuts, layout, code, network);
  out.cells = std::sqrt(static_cast<double>(costs.rows()) * static_cast<double>(costs.columns()) / ranks);
  if (grid.columns.edge > 1) {
    CellColumns coarser = grid.columns;
    coarser.edge *= 2;
    const std::vector<double> fine = part_costs(costs, cuts),
                              rough = part_costs(particles_of(domain, coarser, particles), cuts);
    for (std::size_t k = 0; k < fine.size(); ++k)
      out.burden.blurred = std::max(out.burden.blurred, std::abs(rough[k] / fine[k] - 1));
  }
  return out;
}

/// What a step has besides computing its own share: the largest of it limits the scaling.
const char* limit_of(const Step& s) {
  const double uneven = s.compute * (1 - 1 / s.imbalance);
  const std::pair<double, const char*> parts[]{
      {uneven, "imbalance"}, {s.pack, "packing halos"}, {s.exposed, "messages"}, {s.reduce, "reduction"}};
  return std::ranges::max_element(parts)->second;
}

void print_table(const Domain& domain, const Scaling& o, const Code& code, bool weak) {
  fmt::print("\n{} scaling, {}: {:.3g} particles{}\n", weak ? "Weak" : "Strong", domain.name,
             weak ? o.particles_per_rank : o.particles, weak ? " a rank" : "");
  fmt::print(
      "  ranks  particles  cells  imbal.  halo/part.  step [ms] = compute + pack + exposed + reduce + "
      "rebuild  hidden  "
      "efficiency  limit          memory/rank  checkpoint\n");
  double first = 0;
  for (const int ranks : o.ranks) {
    const double particles = weak ? o.particles_per_rank * ranks : o.particles;
    Case c;
    try {
      c = run(domain, particles, ranks, code, o.network);
    } catch (const InputError& error) {
      fmt::print("{:7}  {}\n", ranks, error.what());
      continue;
    }
    const double share = c.step.total() * (weak ? 1 : ranks);
    if (first == 0) first = share;
    fmt::print(
        "{:7} {:10.2g} {:6.1f} {:7.3f} {:11.3f} {:10.3f}   {:8.3f} {:6.3f} {:8.3f} {:8.4f} {:8.3f} {:9.0f} % "
        "{:10.3f}   "
        "{:14} {:8.2f} GB {:9.1f} s\n",
        ranks, particles, c.cells, c.step.imbalance, c.step.halo, 1e3 * c.step.total(), 1e3 * c.step.compute,
        1e3 * c.step.pack, 1e3 * c.step.exposed, 1e3 * c.step.reduce, 1e3 * c.step.rebuild,
        100 * (1 - c.step.exposed / c.step.messages), first / share, limit_of(c.step), 1e-9 * c.step.memory,
        particles * code.checkpoint / o.network.disk);
    fmt::print(
        "         on each rank: cuts {:.0f} kB ({:.1f} bytes for each rank of the run), {:.1f} MB and {:.0f} "
        "ms while "
        "deciding; {:.1f} neighbours, {:.1f} migration peers, found in {:.0f} us; cells taken as one: {:.1f} "
        "%\n",
        1e-3 * c.burden.held, c.burden.held / ranks, 1e-6 * c.burden.deciding, 1e3 * c.burden.decide,
        c.burden.neighbours, c.burden.peers, 1e6 * c.burden.look, 100 * c.burden.blurred);
    std::fflush(stdout);
  }
}

}  // namespace

void predict_scaling(const Scaling& o) {
  const Code code = read_code(o.run / "perf.json");
  fmt::print(
      "code: {:.1f} ns a particle and step, {:.1f} ns a halo row, rebuild of {:.0f} ns a row every {:.0f} "
      "steps, {:.0f} "
      "bytes a halo row,\n      {:.0f} bytes a particle, {:.0f} on disk, set-up {:.2f} us a particle\n",
      1e9 * code.particle, 1e9 * code.halo_row, 1e9 * code.rebuild_row, code.rebuild_every,
      code.refresh_bytes, code.memory, code.checkpoint, 1e6 * code.setup);
  fmt::print("network: latency {:.2g} s, {:.2g} bytes/s a rank; file system {:.2g} bytes/s\n",
             o.network.latency, o.network.bandwidth, o.network.disk);
  print_table(sandbox, o, code, true);
  print_table(cube, o, code, true);
  print_table(sandbox, o, code, false);
}

}  // namespace scale_sim
