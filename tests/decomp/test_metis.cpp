// The METIS wrapper: graph, weights and the two measures, against hand counts and brute force.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "decomp/metis.hpp"

namespace {

using namespace decomp;

/// Cells needed by other parts, counted from the receiving side: distinct (part, foreign cell) pairs.
std::int64_t halo_by_brute_force(const CellGrid& grid, const std::vector<int>& part) {
  const Int3& n = grid.cells();
  const auto part_at = [&](const Int3& c) {
    return part[static_cast<std::size_t>((c[2] * n[1] + c[1]) * n[0] + c[0])];
  };
  const auto adjacent = [&](int axis, std::int64_t a, std::int64_t b) {
    const std::int64_t d = std::abs(a - b);
    return d <= 1 || (grid.periodic()[axis] && d == n[axis] - 1);
  };
  std::vector<Int3> cells;
  for (std::int64_t k = 0; k < n[2]; ++k)
    for (std::int64_t j = 0; j < n[1]; ++j)
      for (std::int64_t i = 0; i < n[0]; ++i) cells.push_back({i, j, k});
  std::set<std::pair<int, Int3>> needed;
  for (const Int3& a : cells)
    for (const Int3& b : cells)
      if (part_at(a) != part_at(b) && adjacent(0, a[0], b[0]) && adjacent(1, a[1], b[1]) &&
          adjacent(2, a[2], b[2]))
        needed.emplace(part_at(a), b);
  return static_cast<std::int64_t>(needed.size());
}

TEST(Metis, BalancesAFewPartsOfAUniformGrid) {
  const CellGrid grid(2, {}, {24, 24, 0}, {}, 1);
  const std::vector<double> cost(24 * 24, 0.25);
  const GraphPartition p = metis_partition(grid, cost, 6);
  EXPECT_EQ(std::set<int>(p.part.begin(), p.part.end()).size(), 6U);
  EXPECT_GE(p.imbalance, 1);
  EXPECT_LT(p.imbalance, 1.05);
  EXPECT_EQ(p.halo_cells, halo_by_brute_force(grid, p.part));
  EXPECT_EQ(metis_partition(grid, cost, 6).part, p.part);
}

TEST(Metis, FollowsTheCosts) {
  const CellGrid grid(3, {}, {12, 10, 4}, {true, false, true}, 1);
  std::vector<double> cost;
  for (int c = 0; c < 12 * 10 * 4; ++c) cost.push_back(c % 12 < 6 ? 1e-7 : 9e-7);  // seconds
  const GraphPartition p = metis_partition(grid, cost, 4);
  EXPECT_LT(p.imbalance, 1.08);
  EXPECT_EQ(p.halo_cells, halo_by_brute_force(grid, p.part));
  std::vector<int> cells_of(4, 0);
  for (const int part : p.part) ++cells_of[static_cast<std::size_t>(part)];
  EXPECT_GT(*std::ranges::max_element(cells_of), 130);  // an equal number of cells would be 120
}

TEST(Metis, MeasuresSlabsAsCountedByHand) {
  std::vector<int> halves;
  for (int c = 0; c < 36; ++c) halves.push_back(c % 6 / 3);
  const std::vector<double> cost(36, 2.0);
  const CellGrid open(2, {}, {6, 6, 0}, {}, 1);
  const CellGrid periodic(2, {}, {6, 6, 0}, {true, true, false}, 1);
  EXPECT_EQ(measure_partition(open, cost, halves, 2).halo_cells, 12);      // one column each way
  EXPECT_EQ(measure_partition(periodic, cost, halves, 2).halo_cells, 24);  // and one through the wrap
  EXPECT_EQ(measure_partition(open, cost, halves, 2).imbalance, 1);
  EXPECT_EQ(measure_partition(open, cost, halves, 3).imbalance, 1.5);  // the third part is empty
  EXPECT_THROW((void)measure_partition(open, cost, halves, 1), InputError);
}

TEST(Metis, HandlesTheExtremes) {
  const CellGrid grid(2, {}, {5, 4, 0}, {}, 1);
  const std::vector<double> cost(20, 1.0);
  const GraphPartition one = metis_partition(grid, cost, 1);
  EXPECT_EQ(one.halo_cells, 0);
  EXPECT_EQ(one.imbalance, 1);
  EXPECT_EQ(metis_partition(grid, std::vector<double>(20, 0.0), 3).imbalance, 1);
  EXPECT_THROW((void)metis_partition(grid, cost, 21), InputError);
  EXPECT_THROW((void)metis_partition(grid, cost, 0), InputError);
  EXPECT_THROW((void)metis_partition(grid, std::vector<double>(19, 1.0), 2), InputError);
  EXPECT_THROW((void)metis_partition(grid, std::vector<double>(20, -1.0), 2), InputError);
  EXPECT_THROW((void)metis_partition(grid, std::vector<double>(20, std::nan("")), 2), InputError);
}

}  // namespace
