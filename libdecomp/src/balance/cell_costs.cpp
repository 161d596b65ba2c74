#include "decomp/cell_costs.hpp"

#include <algorithm>
#include <utility>

namespace decomp {

CellCosts::CellCosts(const CellColumns& grid, std::span<const double> cost) : grid_(grid) {
  const auto rows = static_cast<std::size_t>(grid.coarse(grid.rows)),
             columns = static_cast<std::size_t>(grid.coarse(grid.columns)), stride = columns + 1;
  before_.assign((rows + 1) * stride, 0.0);
  for (std::size_t r = 0; r < rows; ++r) {
    double line = 0;
    for (std::size_t c = 0; c < columns; ++c) {
      line += cost[r * columns + c];
      before_[(r + 1) * stride + c + 1] = before_[r * stride + c + 1] + line;
    }
  }
}

CellCosts::CellCosts(std::span<const CellCosts> costs, std::span<const double> weight)
    : grid_(costs[0].grid_), before_(costs[0].before_.size(), 0.0) {
  for (std::size_t k = 0; k < costs.size(); ++k)
    for (std::size_t n = 0; n < before_.size(); ++n) before_[n] += weight[k] * costs[k].before_[n];
}

// Bilinear in the coarse cell; the last one may be cut short by the end of the grid.
double CellCosts::between(std::int64_t r, std::int64_t c) const {
  const auto place = [&](std::int64_t x, std::int64_t cells) {
    const std::int64_t k = std::min(x / grid_.edge, grid_.coarse(cells) - 1), first = k * grid_.edge;
    const std::int64_t last = std::min(first + grid_.edge, cells);
    return std::pair(k, static_cast<double>(x - first) / static_cast<double>(last - first));
  };
  const auto [i, u] = place(r, grid_.rows);
  const auto [j, w] = place(c, grid_.columns);
  return (1 - u) * ((1 - w) * corner(i, j) + w * corner(i, j + 1)) +
         u * ((1 - w) * corner(i + 1, j) + w * corner(i + 1, j + 1));
}

std::vector<double> part_costs(const CellCosts& costs, const Cuts& cuts, Slowness slowness) {
  std::vector<double> parts;
  for (std::size_t r = 0; r < cuts.column.size(); ++r)
    for (std::size_t c = 0; c + 1 < cuts.column[r].size(); ++c)
      parts.push_back(costs.sum(cuts.row[r], cuts.row[r + 1], cuts.column[r][c], cuts.column[r][c + 1]) *
                      (slowness.empty() ? 1.0 : slowness[parts.size()]));
  return parts;
}

double largest_part(const CellCosts& costs, const Cuts& cuts, Slowness slowness) {
  return std::ranges::max(part_costs(costs, cuts, slowness));
}

double moved_share(const CellCosts& costs, const Cuts& before, const Cuts& after) {
  double kept = 0;
  std::size_t old_first = 0, new_first = 0;
  std::size_t p = 0;  // row of `before` that has the rank looked at
  for (std::size_t r = 0; r < after.column.size(); ++r) {
    const auto& line = after.column[r];
    for (std::size_t c = 0; c + 1 < line.size(); ++c) {
      const std::size_t rank = new_first + c;
      while (rank >= old_first + before.column[p].size() - 1) old_first += before.column[p++].size() - 1;
      const auto& old = before.column[p];
      const std::size_t k = rank - old_first;
      const std::int64_t r0 = std::max(before.row[p], after.row[r]),
                         r1 = std::min(before.row[p + 1], after.row[r + 1]);
      const std::int64_t c0 = std::max(old[k], line[c]), c1 = std::min(old[k + 1], line[c + 1]);
      if (r0 < r1 && c0 < c1) kept += costs.sum(r0, r1, c0, c1);
    }
    new_first += line.size() - 1;
  }
  return 1 - kept / costs.total();
}

std::vector<int> shape_of(const Cuts& cuts) {
  std::vector<int> shape;
  for (const auto& line : cuts.column) shape.push_back(static_cast<int>(line.size()) - 1);
  return shape;
}

}  // namespace decomp
