#include "decomp/metis.hpp"

#include <metis.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

namespace decomp {

namespace {

std::size_t cell_count(const CellGrid& grid) {
  const Int3& n = grid.cells();
  return static_cast<std::size_t>(n[0]) * static_cast<std::size_t>(n[1]) * static_cast<std::size_t>(n[2]);
}

/// Cells that share a face, edge or corner with `cell`, itself excepted; appended to `found`. A periodic axis
/// has three cells or more, so no neighbour appears twice.
void append_neighbours(const CellGrid& grid, const Int3& cell, std::vector<idx_t>& found) {
  const Int3& n = grid.cells();
  const auto along = [&](int axis, std::int64_t offset) {
    const std::int64_t i = cell[axis] + offset;
    if (i >= 0 && i < n[axis]) return i;
    return grid.periodic()[axis] ? (i + n[axis]) % n[axis] : std::int64_t{-1};
  };
  for (std::int64_t k = -1; k <= 1; ++k)
    for (std::int64_t j = -1; j <= 1; ++j)
      for (std::int64_t i = -1; i <= 1; ++i) {
        const Int3 other{along(0, i), along(1, j), along(2, k)};
        if ((i == 0 && j == 0 && k == 0) || std::ranges::min(other) < 0) continue;
        found.push_back(static_cast<idx_t>((other[2] * n[1] + other[1]) * n[0] + other[0]));
      }
}

struct Graph {
  std::vector<idx_t> begin{0};  ///< [cells + 1]
  std::vector<idx_t> neighbour;
};

Graph cell_graph(const CellGrid& grid) {
  constexpr std::size_t most_neighbours = 26;
  if (cell_count(grid) > static_cast<std::size_t>(std::numeric_limits<idx_t>::max()) / most_neighbours)
    throw InputError(std::to_string(cell_count(grid)) + " cells are too many for METIS");
  Graph graph;
  graph.begin.reserve(cell_count(grid) + 1);
  const Int3& n = grid.cells();
  for (std::int64_t k = 0; k < n[2]; ++k)
    for (std::int64_t j = 0; j < n[1]; ++j)
      for (std::int64_t i = 0; i < n[0]; ++i) {
        append_neighbours(grid, {i, j, k}, graph.neighbour);
        graph.begin.push_back(static_cast<idx_t>(graph.neighbour.size()));
      }
  return graph;
}

double checked_total(const CellGrid& grid, const std::vector<double>& cost) {
  if (cost.size() != cell_count(grid))
    throw InputError(std::to_string(cost.size()) + " costs for " + std::to_string(cell_count(grid)) +
                     " cells");
  for (const double c : cost)
    if (!(c >= 0) || !std::isfinite(c)) throw InputError("a cell cost is negative or not finite");
  return std::accumulate(cost.begin(), cost.end(), 0.0);
}

/// METIS wants integers whose sum fits its 32 bits with room for its own factors.
std::vector<idx_t> integer_weights(const std::vector<double>& cost, double total) {
  constexpr double wanted_total = 5e8;
  std::vector<idx_t> weight(cost.size(), 1);
  if (total > 0)
    std::ranges::transform(cost, weight.begin(), [&](double c) {
      return static_cast<idx_t>(std::lround(c / total * wanted_total));
    });
  return weight;
}

GraphPartition measure(const Graph& graph, const std::vector<double>& cost, std::vector<int> part,
                       int ranks) {
  std::vector<double> load(static_cast<std::size_t>(ranks), 0.0);
  for (std::size_t c = 0; c < part.size(); ++c) load[static_cast<std::size_t>(part[c])] += cost[c];
  const double mean = std::accumulate(load.begin(), load.end(), 0.0) / ranks;
  GraphPartition result{{}, mean > 0 ? std::ranges::max(load) / mean : 1.0, 0};
  std::vector<int> needed_by;
  for (std::size_t c = 0; c < part.size(); ++c) {
    needed_by.clear();
    for (auto e = graph.begin[c]; e < graph.begin[c + 1]; ++e) {
      const int other = part[static_cast<std::size_t>(graph.neighbour[static_cast<std::size_t>(e)])];
      if (other != part[c] && std::ranges::find(needed_by, other) == needed_by.end())
        needed_by.push_back(other);
    }
    result.halo_cells += static_cast<std::int64_t>(needed_by.size());
  }
  result.part = std::move(part);
  return result;
}

}  // namespace

GraphPartition metis_partition(const CellGrid& grid, const std::vector<double>& cost, int ranks) {
  const double total = checked_total(grid, cost);
  if (ranks < 1 || static_cast<std::size_t>(ranks) > cost.size())
    throw InputError(std::to_string(ranks) + " ranks do not fit " + std::to_string(cost.size()) + " cells");
  Graph graph = cell_graph(grid);
  std::vector<idx_t> part(cost.size(), 0);
  if (ranks > 1) {
    std::vector<idx_t> weight = integer_weights(cost, total);
    std::array<idx_t, METIS_NOPTIONS> options{};
    METIS_SetDefaultOptions(options.data());
    options[METIS_OPTION_SEED] = 1;      // the same partition at every call
    options[METIS_OPTION_UFACTOR] = 10;  // allow 1 % of imbalance
    auto cells = static_cast<idx_t>(cost.size());
    idx_t constraints = 1;
    idx_t parts = ranks;
    idx_t edges_cut = 0;
    const int status = METIS_PartGraphKway(&cells, &constraints, graph.begin.data(), graph.neighbour.data(),
                                           weight.data(), nullptr, nullptr, &parts, nullptr, nullptr,
                                           options.data(), &edges_cut, part.data());
    if (status != METIS_OK) throw std::runtime_error("METIS_PartGraphKway failed");
  }
  return measure(graph, cost, {part.begin(), part.end()}, ranks);
}

GraphPartition measure_partition(const CellGrid& grid, const std::vector<double>& cost, std::vector<int> part,
                                 int ranks) {
  (void)checked_total(grid, cost);
  if (part.size() != cost.size()) throw InputError("a partition needs one part for each cell");
  for (const int p : part)
    if (p < 0 || p >= ranks) throw InputError("part " + std::to_string(p) + " is not a rank");
  return measure(cell_graph(grid), cost, std::move(part), ranks);
}

}  // namespace decomp
