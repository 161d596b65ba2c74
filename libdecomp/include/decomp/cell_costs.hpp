// Costs of the columns of cells that a jagged partition shares out, summed over any rectangle at once.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "decomp/partition.hpp"

namespace decomp {

/// A grid of columns of cells, `edge` x `edge` of them taken as one: row r, column c of the cells belong to
/// index(r, c) of arrays of size().
struct CellColumns {
  std::int64_t rows, columns, edge = 1;  ///< [cells]
  [[nodiscard]] std::int64_t coarse(std::int64_t cells) const { return (cells + edge - 1) / edge; }
  [[nodiscard]] std::int64_t size() const { return coarse(rows) * coarse(columns); }
  [[nodiscard]] std::size_t index(std::int64_t r, std::int64_t c) const {
    return static_cast<std::size_t>(r / edge * coarse(columns) + c / edge);
  }
};

class CellCosts {
 public:
  /// `cost` [grid.size()], each >= 0; spread evenly over the cells that were taken as one.
  CellCosts(const CellColumns& grid, std::span<const double> cost);
  CellCosts(std::int64_t rows, std::int64_t columns, std::span<const double> cost)
      : CellCosts(CellColumns{rows, columns}, cost) {}
  /// Sum over k of weight[k] times costs[k]; all of one grid.
  CellCosts(std::span<const CellCosts> costs, std::span<const double> weight);

  [[nodiscard]] std::int64_t rows() const { return grid_.rows; }
  [[nodiscard]] std::int64_t columns() const { return grid_.columns; }
  /// Of the cells r0 <= row < r1, c0 <= column < c1.
  [[nodiscard]] double sum(std::int64_t r0, std::int64_t r1, std::int64_t c0, std::int64_t c1) const {
    return at(r1, c1) - at(r0, c1) - at(r1, c0) + at(r0, c0);
  }
  [[nodiscard]] double total() const { return at(rows(), columns()); }

 private:
  [[nodiscard]] double corner(std::int64_t r, std::int64_t c) const {
    return before_[static_cast<std::size_t>(r * (grid_.coarse(grid_.columns) + 1) + c)];
  }
  [[nodiscard]] double at(std::int64_t r, std::int64_t c) const {
    return grid_.edge == 1 ? corner(r, c) : between(r, c);
  }
  [[nodiscard]] double between(std::int64_t r, std::int64_t c) const;
  CellColumns grid_;
  std::vector<double> before_;  ///< [coarse rows + 1][coarse columns + 1] summed over all cells before
};

/// What each part costs, in the order of the ranks; `slowness`: of each rank, a factor of all its costs.
/// Where it is empty all are 1.
using Slowness = std::span<const double>;
[[nodiscard]] std::vector<double> part_costs(const CellCosts& costs, const Cuts& cuts,
                                             Slowness slowness = {});
[[nodiscard]] double largest_part(const CellCosts& costs, const Cuts& cuts, Slowness slowness = {});
/// Share of the costs that belongs to another rank after the cuts have moved.
[[nodiscard]] double moved_share(const CellCosts& costs, const Cuts& before, const Cuts& after);

/// The best partition into rows with the given numbers of columns: no other has a smaller largest part, to
/// within 1e-6 of the mean. Bisection of the bottleneck; for each the widest rows whose columns, filled
/// greedily, stay below it (Pinar & Aykanat 2004; exact since a wider part never costs less). With unequal
/// slowness or numbers of columns it is near the best: where parts are a few cells it may matter which rank
/// gets a dear one. Every part is at least JaggedPartition::min_width cells wide. Throws InputError where the
/// parts do not fit the cells.
[[nodiscard]] Cuts best_cuts(const CellCosts& costs, std::span<const int> shape, Slowness slowness = {});

/// A good partition into `parts` whose rows have their own numbers of columns: for each of some numbers of
/// rows the best cuts of the row sums, then the numbers of columns that make the bottleneck least for those
/// rows (Saule et al. 2012, m-way jagged), then the row cuts again for those numbers, while that helps.
[[nodiscard]] Cuts good_cuts(const CellCosts& costs, int parts, Slowness slowness = {});

[[nodiscard]] std::vector<int> shape_of(const Cuts& cuts);  ///< number of columns of each row

}  // namespace decomp
