#include "decomp/cell_costs.hpp"

#include <algorithm>

namespace decomp {

CellCosts::CellCosts(std::int64_t rows, std::int64_t columns, std::span<const double> cost)
    : rows_(rows), columns_(columns), before_(static_cast<std::size_t>((rows + 1) * (columns + 1)), 0.0) {
  const std::size_t stride = static_cast<std::size_t>(columns + 1);
  for (std::size_t r = 0; r < static_cast<std::size_t>(rows); ++r) {
    double line = 0;
    for (std::size_t c = 0; c + 1 < stride; ++c) {
      line += cost[r * (stride - 1) + c];
      before_[(r + 1) * stride + c + 1] = before_[r * stride + c + 1] + line;
    }
  }
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
