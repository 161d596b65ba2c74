// Jagged partition against brute force over all ranks and all 27 images; shapes for any number of ranks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <set>

#include "decomp/cell_costs.hpp"
#include "decomp/cut_policy.hpp"
#include "decomp/partition.hpp"

namespace {

using namespace decomp;

/// Random numbers that are the same on every rank and with every standard library.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  std::int64_t in(std::int64_t lo, std::int64_t hi) {  ///< inclusive
    return lo + static_cast<std::int64_t>(engine_() % static_cast<std::uint64_t>(hi - lo + 1));
  }

 private:
  std::mt19937_64 engine_;
};

/// A random grid with any periodicity, axes, numbers of rows and columns, and chaotic cuts.
JaggedPartition random_partition(Dice& dice, std::int64_t most_cells) {
  const auto dim = static_cast<int>(dice.in(1, 3));
  Int3 origin{}, length{};
  std::array<bool, 3> periodic{};
  for (int a = 0; a < dim; ++a) {
    origin[a] = dice.in(-50, 50);
    length[a] = dice.in(30, 10 * most_cells);
    periodic[a] = dice.in(0, 1) == 1;
  }
  const CellGrid grid(dim, origin, length, periodic, 10);
  const auto row_axis = static_cast<int>(dice.in(0, 2));
  const auto column_axis = static_cast<int>((row_axis + dice.in(1, 2)) % 3);
  const CutLimits limits{grid.cells()[row_axis], grid.cells()[column_axis]};
  Cuts shape;
  shape.row.resize(static_cast<std::size_t>(dice.in(2, limits.row_cells + 1)));
  for (std::size_t r = 0; r + 1 < shape.row.size(); ++r)
    shape.column.emplace_back(static_cast<std::size_t>(dice.in(2, limits.column_cells + 1)));
  const auto seed = static_cast<std::uint64_t>(dice.in(0, 1 << 30));
  return {grid, row_axis, column_axis, make_chaos(seed)->next(shape, {}, limits)};
}

std::vector<Int3> all_shifts(const CellGrid& grid) {
  std::vector<Int3> shifts;
  const auto along = [&](int a) { return grid.periodic()[a] ? grid.length()[a] : std::int64_t{0}; };
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j)
      for (int k = -1; k <= 1; ++k) shifts.push_back({i * along(0), j * along(1), k * along(2)});
  std::sort(shifts.begin(), shifts.end());
  shifts.erase(std::unique(shifts.begin(), shifts.end()), shifts.end());
  return shifts;
}

TEST(Partition, PartsTileTheGridAndOwnerAgrees) {
  Dice dice(1);
  for (int round = 0; round < 200; ++round) {
    const JaggedPartition p = random_partition(dice, 9);
    const Int3& n = p.grid().cells();
    std::int64_t cells = 0;
    for (Rank r = 0; r < p.ranks(); ++r) {
      const Box box = p.cells(r);
      ASSERT_FALSE(box.empty());
      for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i)
        for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j)
          for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k, ++cells) ASSERT_EQ(p.owner({i, j, k}), r);
    }
    ASSERT_EQ(cells, n[0] * n[1] * n[2]);
  }
}

TEST(Partition, BoxInQuantaHoldsExactlyTheOwnedPositions) {
  Dice dice(2);
  for (int round = 0; round < 200; ++round) {
    const JaggedPartition p = random_partition(dice, 9);
    for (int n = 0; n < 50; ++n) {
      Int3 x{};
      for (int a = 0; a < p.grid().dim(); ++a)
        x[a] = p.grid().origin()[a] + dice.in(-40, p.grid().length()[a] + 40);
      x = p.grid().wrap(x);
      const Rank owner = p.owner(p.grid().cell_of(x));
      for (Rank r = 0; r < p.ranks(); ++r) ASSERT_EQ(p.quanta(r).contains(x), r == owner);
    }
  }
}

TEST(Partition, NeighboursMatchAllRanksAndImages) {
  Dice dice(3);
  for (int round = 0; round < 200; ++round) {
    const JaggedPartition p = random_partition(dice, 6);
    const std::int64_t reach = dice.in(0, 25);
    const auto shifts = all_shifts(p.grid());
    for (Rank r = 0; r < p.ranks(); ++r) {
      const Box mine = p.quanta(r);
      std::vector<JaggedPartition::Image> expected;
      for (Rank s = 0; s < p.ranks(); ++s)
        for (const Int3& shift : shifts) {
          if (s == r && shift == Int3{}) continue;
          const Box theirs = p.quanta(s);
          bool close = true;
          for (int a = 0; a < 3; ++a) {
            const std::int64_t gap = std::max({theirs.lo[a] + shift[a] - mine.hi[a],
                                               mine.lo[a] - theirs.hi[a] - shift[a], std::int64_t{0}});
            close = close && gap < reach;
          }
          if (close) expected.push_back({s, shift});
        }
      const auto found = p.neighbours(r, reach);
      ASSERT_EQ(found.size(), expected.size());
      ASSERT_TRUE(found == expected);  // the loops above run in the promised order
      for (const auto& [s, shift] : found) {
        const auto back = p.neighbours(s, reach);
        const JaggedPartition::Image mirror{r, {-shift[0], -shift[1], -shift[2]}};
        ASSERT_EQ(std::count(back.begin(), back.end(), mirror), 1);
      }
    }
  }
}

TEST(Partition, EveryCopyWithinReachBelongsToANeighbour) {
  Dice dice(4);
  int pairs_across = 0;
  for (int round = 0; round < 40; ++round) {
    const JaggedPartition p = random_partition(dice, 6);
    const CellGrid& grid = p.grid();
    const std::int64_t reach = 10;
    const auto shifts = all_shifts(grid);
    std::vector<Int3> points;
    for (int n = 0; n < 60; ++n) {
      Int3 x{};
      for (int a = 0; a < grid.dim(); ++a) x[a] = grid.origin()[a] + dice.in(-15, grid.length()[a] + 15);
      points.push_back(grid.wrap(x));
    }
    for (const Int3& x : points)
      for (const Int3& y : points)
        for (const Int3& shift : shifts) {
          bool close = true;
          for (int a = 0; a < 3; ++a) close = close && std::abs(x[a] + shift[a] - y[a]) <= reach;
          const JaggedPartition::Image image{p.owner(grid.cell_of(x)), shift};
          const Rank me = p.owner(grid.cell_of(y));
          if (!close || image == JaggedPartition::Image{me, {}}) continue;
          const auto found = p.neighbours(me, reach);
          ASSERT_EQ(std::count(found.begin(), found.end(), image), 1);
          pairs_across += 1;
        }
  }
  EXPECT_GT(pairs_across, 1000);
}

TEST(Partition, ASingleRankSeesItsOwnImages) {
  const CellGrid grid(3, {}, {30, 30, 30}, {true, true, true}, 10);
  const JaggedPartition p(grid, 0, 1, uniform_cuts(1, 3, 3));
  EXPECT_EQ(p.neighbours(0, 10).size(), 26U);
  EXPECT_TRUE(p.neighbours(0, 0).empty());
  EXPECT_THROW((void)p.neighbours(0, 30), InputError);
  const CellGrid closed(3, {}, {30, 30, 30}, {}, 10);
  EXPECT_TRUE(JaggedPartition(closed, 0, 1, uniform_cuts(1, 3, 3)).neighbours(0, 10).empty());
}

TEST(Partition, RanksTouchingABoxMatchesBruteForce) {
  Dice dice(5);
  for (int round = 0; round < 200; ++round) {
    const JaggedPartition p = random_partition(dice, 8);
    const CellGrid& grid = p.grid();
    Box box;
    for (int a = 0; a < grid.dim(); ++a) {
      box.lo[a] = dice.in(-150, 150);
      box.hi[a] = box.lo[a] + dice.in(round % 10 == 0 ? 0 : 1, 60);
    }
    std::set<Rank> expected;
    const bool empty = [&] {
      for (int a = 0; a < grid.dim(); ++a)
        if (box.lo[a] >= box.hi[a]) return true;
      return false;
    }();
    for (Rank r = 0; r < p.ranks() && !empty; ++r)
      for (int i = -12; i <= 12; ++i)  // the box is at most 12 of the shortest periods away
        for (int j = -12; j <= 12; ++j) {
          const Box mine = p.quanta(r);
          const auto meets = [&](int a, std::int64_t periods) {
            if (a >= grid.dim()) return true;
            const std::int64_t shift = grid.periodic()[a] ? periods * grid.length()[a] : 0;
            return mine.lo[a] + shift < box.hi[a] && box.lo[a] < mine.hi[a] + shift;
          };
          if (meets(p.row_axis(), i) && meets(p.column_axis(), j)) expected.insert(r);
        }
    ASSERT_EQ(p.ranks_touching(box), std::vector<Rank>(expected.begin(), expected.end()));
  }
}

TEST(Partition, RanksTouchingAnUnboundedBoxIsEverybody) {
  Dice dice(6);
  constexpr std::int64_t far_away = std::int64_t{1} << 62;
  for (int round = 0; round < 20; ++round) {
    const JaggedPartition p = random_partition(dice, 8);
    const Box all{{-far_away, -far_away, -far_away}, {far_away, far_away, far_away}};
    ASSERT_EQ(p.ranks_touching(all).size(), static_cast<std::size_t>(p.ranks()));
  }
}

TEST(Partition, RefusesIllegalCuts) {
  const CellGrid grid(2, {}, {60, 40, 0}, {}, 10);  // 6 x 4 cells
  const auto make = [&](const Cuts& cuts) { return JaggedPartition(grid, 0, 1, cuts); };
  EXPECT_NO_THROW(make({{0, 2, 6}, {{0, 4}, {0, 1, 4}}}));
  EXPECT_THROW(make({{0, 2, 5}, {{0, 4}, {0, 1, 4}}}), InputError);
  EXPECT_THROW(make({{1, 2, 6}, {{0, 4}, {0, 1, 4}}}), InputError);
  EXPECT_THROW(make({{0, 2, 6}, {{0, 4}}}), InputError);
  EXPECT_THROW(make({{0, 2, 6}, {{0, 4}, {0, 2, 2, 4}}}), InputError);
  EXPECT_THROW(make({{0, 2, 6}, {{0, 4}, {0, 3, 2, 4}}}), InputError);
  EXPECT_THROW(make({{0}, {}}), InputError);
  EXPECT_THROW(JaggedPartition(grid, 1, 1, Cuts{{0, 4}, {{0, 4}}}), InputError);
}

TEST(Shape, EveryFeasibleRankCountWorksAndNoLargerOne) {
  for (const auto& [rows, columns] :
       {std::pair<int, int>{17, 23}, {1, 40}, {40, 1}, {5, 5}, {9, 4}, {7, 3}, {3, 90}}) {
    const auto most = static_cast<int>(max_ranks(rows, columns));
    EXPECT_EQ(most, rows * columns);
    const CellGrid grid(2, {}, {10 * rows, 10 * columns, 0}, {}, 10);
    for (int n = 1; n <= most; ++n) {
      const std::vector<int> shape = jagged_shape(n, rows, columns);
      ASSERT_EQ(std::accumulate(shape.begin(), shape.end(), 0), n);
      const auto [least, largest] = std::minmax_element(shape.begin(), shape.end());
      ASSERT_LE(*largest - *least, 1);
      ASSERT_NO_THROW(JaggedPartition(grid, 0, 1, uniform_cuts(n, rows, columns))) << n;
    }
    EXPECT_THROW((void)jagged_shape(most + 1, rows, columns), InputError);
  }
  EXPECT_THROW((void)uniform_cuts(0, 17, 23), InputError);
  try {
    (void)uniform_cuts(1000, 17, 23);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(), "1000 ranks are too many for 17 x 23 cells of the cut axes: at most 391 ranks");
  }
}

TEST(Shape, SeedFormWhereItIsGood) {
  EXPECT_EQ(jagged_shape(484, 480, 480), std::vector<int>(22, 22));
  EXPECT_EQ(jagged_shape(8, 100, 100), std::vector<int>(2, 4));
  EXPECT_EQ(jagged_shape(8, 200, 100), std::vector<int>(4, 2));
  EXPECT_EQ(jagged_shape(1, 100, 100), std::vector<int>{1});
  EXPECT_EQ(jagged_shape(7, 10, 1000), std::vector<int>{7});          // a long channel
  EXPECT_EQ(jagged_shape(7, 1000, 10), std::vector<int>(7, 1));       // the other way round
  EXPECT_EQ(jagged_shape(7, 100, 100), (std::vector<int>{2, 2, 3}));  // not seven slabs
}

TEST(Shape, PartsAreNearSquareAndOfEqualArea) {
  constexpr std::int64_t cells = 2000;
  for (int n = 1; n <= 300; ++n) {
    const Cuts cuts = uniform_cuts(n, cells, cells);
    const double ideal = static_cast<double>(cells) * cells / n;
    double half_perimeter = 0;
    for (std::size_t r = 0; r < cuts.column.size(); ++r) {
      const auto height = static_cast<double>(cuts.row[r + 1] - cuts.row[r]);
      for (std::size_t c = 0; c + 1 < cuts.column[r].size(); ++c) {
        const auto across = static_cast<double>(cuts.column[r][c + 1] - cuts.column[r][c]);
        EXPECT_NEAR(height * across / ideal, 1, 0.03) << n;
        half_perimeter += height + across;
      }
    }
    // In units of n squares of the same area; thin slabs would have sqrt(n) / 2
    EXPECT_LT(half_perimeter / (2 * n * std::sqrt(ideal)), 1.075) << n;
  }
}

TEST(Partition, NeighboursAreFoundQuicklyAmongManyRanks) {
  constexpr int ranks = 100000;
  const CellGrid grid(3, {}, {20000, 20000, 100}, {true, true, true}, 10);
  const JaggedPartition p(grid, 0, 1, uniform_cuts(ranks, 2000, 2000));
  std::size_t found = 0;
  for (Rank r = 0; r < ranks; r += 10) found += p.neighbours(r, 10).size();
  // 8 to 10 in the plane, each with three images along the uncut axis, and two of itself
  EXPECT_GE(found, 10000U * (3 * 8 + 2));
  EXPECT_LE(found, 10000U * (3 * 10 + 2));
}

}  // namespace

namespace {

// A pile in one corner: every part gets its share as far as cell lines allow, and no part is empty of cells.
TEST(BestCuts, ShareOutAPileInOneCorner) {
  constexpr std::int64_t rows = 40, columns = 30;
  std::vector<std::int64_t> weight(rows * columns, 0);
  for (std::int64_t r = 0; r < rows / 2; ++r)
    for (std::int64_t c = 0; c < columns / 2; ++c) weight[static_cast<std::size_t>(r * columns + c)] = 10;
  const decomp::CellGrid grid(2, {0, 0, 0}, {400, 300, 0}, {false, false, false}, 10);
  for (const int ranks : {1, 2, 3, 4, 7, 12, 101}) {
    const decomp::CellCosts costs(rows, columns, std::vector<double>(weight.begin(), weight.end()));
    const decomp::JaggedPartition partition(
        grid, 0, 1, decomp::best_cuts(costs, decomp::jagged_shape(ranks, rows, columns)));
    ASSERT_EQ(partition.ranks(), ranks);
    if (ranks > 12) continue;
    std::int64_t total = 0, largest = 0;
    for (int r = 0; r < ranks; ++r) {
      const decomp::Box box = partition.cells(r);
      std::int64_t sum = 0;
      for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i)
        for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j)
          sum += weight[static_cast<std::size_t>(i * columns + j)];
      total += sum;
      largest = std::max(largest, sum);
    }
    EXPECT_EQ(total, 10 * rows * columns / 4);
    EXPECT_LE(static_cast<double>(largest), 1.25 * static_cast<double>(total) / ranks) << ranks << " ranks";
  }
}

}  // namespace
