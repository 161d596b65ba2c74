// The balancers on synthetic costs of columns of cells, measured with noise. What a step would wait for is
// the largest part; all figures are over the mean.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>
#include <string>

#include "commands.hpp"
#include "cost_fields.hpp"
#include "decomp/cell_costs.hpp"
#include "decomp/cut_policy.hpp"
#include "decomp/metis.hpp"

namespace scale_sim {
namespace {

using namespace decomp;

struct Field {
  const char* name;
  std::vector<double> (*costs)(std::int64_t rows, std::int64_t columns);
};

std::vector<double> dam_at_start(std::int64_t rows, std::int64_t columns) {
  return fields::dam(rows, columns);
}

struct Course {
  int calls_to_near = -1;   ///< within 10 % of the best cuts with equal columns
  double steady = 0;        ///< mean of the last third
  double microseconds = 0;  ///< of deciding, a call
};

Course run(CutPolicy& policy, const CellCosts& costs, const std::vector<double>& slowness, double optimum,
           const PolicyTable& o) {
  Course course;
  std::mt19937 bits(1);
  std::normal_distribution<double> normal;
  Cuts cuts = uniform_cuts(static_cast<int>(slowness.size()), costs.rows(), costs.columns());
  double speed = 0;
  for (const double s : slowness) speed += 1 / s;
  for (int n = 0; n < o.calls; ++n) {
    const double largest = largest_part(costs, cuts, slowness);
    if (course.calls_to_near < 0 && largest <= 1.1 * optimum) course.calls_to_near = n;
    if (3 * n >= 2 * o.calls)
      course.steady += largest / (costs.total() / speed) / (o.calls - (2 * o.calls + 2) / 3);
    std::vector<double> measured = part_costs(costs, cuts, slowness);
    for (double& t : measured) t *= 1 + o.noise * normal(bits);
    const auto start = std::chrono::steady_clock::now();
    cuts = policy.next(cuts, {measured, {&costs, 1}}, {costs.rows(), costs.columns()});
    course.microseconds +=
        std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count() / o.calls;
  }
  return course;
}

/// Imbalance and halo cells of METIS and of the best cuts, on the same graph of cells.
void against_metis(const std::vector<double>& field, const CellCosts& costs, const Cuts& best, int ranks) {
  const CellGrid grid(2, {}, {costs.rows(), costs.columns(), 0}, {}, 1);
  std::vector<double> cost(field.size());
  std::vector<int> part(field.size());
  const JaggedPartition partition(grid, 0, 1, best);
  for (std::int64_t r = 0; r < costs.rows(); ++r)
    for (std::int64_t c = 0; c < costs.columns(); ++c) {
      const auto at = static_cast<std::size_t>(c * costs.rows() + r);  // x fastest, rows along x
      cost[at] = field[static_cast<std::size_t>(r * costs.columns() + c)];
      part[at] = partition.owner({r, c, 0});
    }
  const GraphPartition ours = measure_partition(grid, cost, part, ranks),
                       metis = metis_partition(grid, cost, ranks);
  fmt::print("   METIS {:.3f}, halo cells {:.2f} of ours\n", metis.imbalance,
             static_cast<double>(metis.halo_cells) / static_cast<double>(ours.halo_cells));
}

}  // namespace

void compare_policies(const PolicyTable& o) {
  const std::vector<Field> all{{"wedge", fields::wedge},
                               {"dam", dam_at_start},
                               {"late dam", fields::late_dam},
                               {"heap", fields::heap}};
  fmt::print(
      "largest part over the mean; calls until within 10 % of the best cuts (-: never), steady state\n");
  for (const int ranks : o.ranks) {
    // At least 30 cells a rank along either axis, as in a run.
    const auto side = static_cast<std::int64_t>(std::max(1.0, std::ceil(std::sqrt(ranks / 484.0))));
    const std::int64_t rows = 240 * side, columns = 480 * side;
    for (const Field& f : all) {
      const std::vector<double> field = f.costs(rows, columns);
      const CellCosts costs(rows, columns, field);
      std::vector<double> slowness(static_cast<std::size_t>(ranks), 1.0);
      if (o.slow_rank >= 0) slowness[static_cast<std::size_t>(o.slow_rank)] = 2;
      const Cuts best = best_cuts(costs, jagged_shape(ranks, rows, columns), slowness);
      const double optimum = largest_part(costs, best, slowness);
      double speed = 0;
      for (const double s : slowness) speed += 1 / s;
      const double mean = costs.total() / speed;
      fmt::print("{:5} ranks {:8}: uniform {:.2f}, best {:.3f};", ranks, f.name,
                 largest_part(costs, uniform_cuts(ranks, rows, columns), slowness) / mean, optimum / mean);
      const auto show = [&](const char* name, std::unique_ptr<CutPolicy> policy) {
        const Course c = run(*policy, costs, slowness, optimum, o);
        fmt::print("  {} {} {:.3f} ({:.0f} us)", name,
                   c.calls_to_near < 0 ? "-" : std::to_string(c.calls_to_near), c.steady, c.microseconds);
        std::fflush(stdout);
      };
      show("literal", make_literal());
      show("quasi_newton", make_quasi_newton());
      show("hybrid", make_hybrid());
      against_metis(field, costs, best, ranks);
    }
  }
}

}  // namespace scale_sim
