// The balancers on synthetic costs: the optimum against brute force, then how near the policies come to it.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "../../benchmarks/scale_sim/cost_fields.hpp"
#include "decomp/cell_costs.hpp"
#include "decomp/cut_policy.hpp"

namespace {

using namespace decomp;

constexpr std::int64_t field_rows = 240, field_columns = 480;

/// All ways to cut `cells` into `parts`.
void each_line(std::int64_t cells, int parts, std::vector<std::int64_t>& line, const auto& use) {
  if (parts == 1) {
    line.push_back(cells);
    use(line);
    line.pop_back();
    return;
  }
  for (std::int64_t c = line.back() + 1; c <= cells - parts + 1; ++c) {
    line.push_back(c);
    each_line(cells, parts - 1, line, use);
    line.pop_back();
  }
}

double brute_force(const CellCosts& costs, const std::vector<int>& shape) {
  double best = 1e300;
  std::vector<std::int64_t> rows{0};
  each_line(costs.rows(), static_cast<int>(shape.size()), rows, [&](const std::vector<std::int64_t>& row) {
    double worst = 0;
    for (std::size_t p = 0; p < shape.size(); ++p) {
      double least = 1e300;
      std::vector<std::int64_t> columns{0};
      each_line(costs.columns(), shape[p], columns, [&](const std::vector<std::int64_t>& line) {
        double most = 0;
        for (std::size_t c = 0; c + 1 < line.size(); ++c)
          most = std::max(most, costs.sum(row[p], row[p + 1], line[c], line[c + 1]));
        least = std::min(least, most);
      });
      worst = std::max(worst, least);
    }
    best = std::min(best, worst);
  });
  return best;
}

// Filled from the left alone, lines end in parts of one cell, which have more halo than grains.
TEST(BestCuts, LeaveNoThinParts) {
  for (const std::int64_t side : {133, 154, 211}) {
    const CellCosts flat(side, side, std::vector<double>(static_cast<std::size_t>(side * side), 1.0));
    for (const int ranks : {64, 100, 144}) {
      const double mean = static_cast<double>(side * side) / ranks;
      for (const Cuts& cuts : {best_cuts(flat, jagged_shape(ranks, side, side)), good_cuts(flat, ranks)})
        EXPECT_GE(std::ranges::min(part_costs(flat, cuts)), 0.5 * mean) << side << ' ' << ranks;
    }
  }
}

RC_GTEST_PROP(BestCuts, AreThoseOfBruteForce, (std::uint32_t seed)) {
  std::mt19937 bits(seed);
  const auto one_of = [&](int low, int high) {
    return low + static_cast<int>(bits() % unsigned(high - low + 1));
  };
  const std::int64_t rows = one_of(3, 6), columns = one_of(4, 8);
  std::vector<double> cost;
  for (std::int64_t k = 0; k < rows * columns; ++k) cost.push_back(one_of(0, 3) == 0 ? 0 : one_of(1, 100));
  cost[0] += 1;
  const CellCosts costs(rows, columns, cost);
  const std::vector<int> shape(static_cast<std::size_t>(one_of(1, 3)), one_of(1, 4));
  const Cuts cuts = best_cuts(costs, shape);
  RC_ASSERT(largest_part(costs, cuts) <= brute_force(costs, shape) * (1 + 1e-5));
  RC_ASSERT(shape_of(cuts) == shape);
}

TEST(BestCuts, AHalfSpeedRankGetsHalf) {
  const CellCosts costs(field_rows, field_columns, fields::late_dam(field_rows, field_columns));
  std::vector<double> slowness(64, 1.0);
  slowness[27] = 2;
  const Cuts cuts = best_cuts(costs, jagged_shape(64, field_rows, field_columns), slowness);
  EXPECT_LT(largest_part(costs, cuts, slowness) / (costs.total() / 63.5), 1.03);
  EXPECT_NEAR(part_costs(costs, cuts)[27] / (costs.total() / 127), 1, 0.1);
}

TEST(CellCosts, AggregatedCellsSpreadTheirCostEvenly) {
  const CellColumns grid{10, 7, 3};  // 4 x 3 columns, the last row and column of them one cell wide
  ASSERT_EQ(grid.size(), 12);
  EXPECT_EQ(grid.index(2, 2), 0u);
  EXPECT_EQ(grid.index(9, 6), 11u);
  std::vector<double> cost(12);
  std::iota(cost.begin(), cost.end(), 1.0);
  const CellCosts costs(grid, cost);
  EXPECT_DOUBLE_EQ(costs.total(), 78);
  EXPECT_DOUBLE_EQ(costs.sum(3, 6, 3, 6), 5);
  EXPECT_DOUBLE_EQ(costs.sum(3, 4, 3, 5), 5.0 * 2 / 9);
  EXPECT_DOUBLE_EQ(costs.sum(9, 10, 6, 7), 12);
  EXPECT_DOUBLE_EQ(costs.sum(2, 4, 0, 1), 1.0 / 9 + 4.0 / 9);
  const std::array<CellCosts, 2> two{costs, costs};
  const std::array<double, 2> weight{2.0, 0.5};
  EXPECT_DOUBLE_EQ(CellCosts(two, weight).sum(1, 8, 2, 6), 2.5 * costs.sum(1, 8, 2, 6));
}

// They begin with the best equal columns, so the question is whether they find better ones where there are.
TEST(GoodCuts, RowsWithTheirOwnColumnsPayOnAHeap) {
  const CellCosts costs(field_rows, field_columns, fields::heap(field_rows, field_columns));
  for (const int ranks : {256, 484}) {
    const double equal =
        largest_part(costs, best_cuts(costs, jagged_shape(ranks, field_rows, field_columns)));
    const Cuts cuts = good_cuts(costs, ranks);
    EXPECT_EQ(static_cast<int>(part_count(cuts)), ranks);
    EXPECT_LT(largest_part(costs, cuts), 0.985 * equal) << ranks;
  }
}

/// A policy in a loop of measuring and moving.
struct Judge {
  CellCosts costs;
  std::vector<double> slowness;
  double noise = 0.02;
  std::mt19937 bits{1};

  explicit Judge(const std::vector<double>& field, int ranks = 64, std::int64_t rows = field_rows,
                 std::int64_t columns = field_columns)
      : costs(rows, columns, field), slowness(static_cast<std::size_t>(ranks), 1.0) {}

  [[nodiscard]] int ranks() const { return static_cast<int>(slowness.size()); }
  [[nodiscard]] double mean() const {
    return costs.total() / std::accumulate(slowness.begin(), slowness.end(), 0.0,
                                           [](double sum, double s) { return sum + 1 / s; });
  }
  [[nodiscard]] double optimum() const {
    return largest_part(costs, best_cuts(costs, jagged_shape(ranks(), field_rows, field_columns), slowness),
                        slowness);
  }
  [[nodiscard]] double largest(const Cuts& cuts) const { return largest_part(costs, cuts, slowness); }

  Cuts call(CutPolicy& policy, const Cuts& cuts) {
    std::normal_distribution<double> normal;
    std::vector<double> measured = part_costs(costs, cuts, slowness);
    for (double& t : measured) t *= 1 + noise * normal(bits);
    return policy.next(
        cuts, {measured, policy.uses_cells() ? std::span(&costs, 1) : std::span<const CellCosts>(), 0},
        {costs.rows(), costs.columns()});
  }

  struct Course {
    int calls_to_near = 1000;  ///< the optimum, within 10 %
    double steady = 0;         ///< largest / optimum, mean of the last 100 of 300 calls
  };
  Course run(CutPolicy& policy) {
    Course course;
    Cuts cuts = uniform_cuts(ranks(), field_rows, field_columns);
    const double best = optimum();
    for (int n = 0; n < 300; ++n) {
      const double ratio = largest(cuts) / best;
      if (ratio <= 1.1) course.calls_to_near = std::min(course.calls_to_near, n);
      if (n >= 200) course.steady += ratio / 100;
      cuts = call(policy, cuts);
    }
    return course;
  }
};

std::vector<std::pair<std::string, std::vector<double>>> static_fields() {
  return {{"wedge", fields::wedge(field_rows, field_columns)},
          {"dam", fields::dam(field_rows, field_columns)},
          {"late dam", fields::late_dam(field_rows, field_columns)},
          {"heap", fields::heap(field_rows, field_columns)}};
}

std::unique_ptr<CutPolicy> make(const std::string& name) {
  return name == "literal" ? make_literal() : name == "quasi_newton" ? make_quasi_newton() : make_hybrid();
}

// Bounds of the issue: R <= 1.05, 1.06, 1.15 at 16, 64, 256 ranks; 1.10 of the optimum after 30 calls at 64.
TEST(Balance, QuasiNewtonComesNearTheOptimumOfStaticCosts) {
  const std::array<std::pair<int, double>, 3> bounds{{{16, 1.05}, {64, 1.06}, {256, 1.15}}};
  for (const auto& [ranks, bound] : bounds)
    for (const auto& [name, field] : static_fields()) {
      const Judge::Course course = Judge(field, ranks).run(*make("quasi_newton"));
      EXPECT_LE(course.steady, bound) << name << " on " << ranks;
      if (ranks <= 64) {
        EXPECT_LE(course.calls_to_near, 30) << name << " on " << ranks;
      }
    }
}

TEST(Balance, HybridIsThereAtOnce) {
  for (const int ranks : {16, 64, 256})
    for (const auto& [name, field] : static_fields()) {
      const Judge::Course course = Judge(field, ranks).run(*make("hybrid"));
      EXPECT_LE(course.steady, 1.02) << name << " on " << ranks;
      EXPECT_LE(course.calls_to_near, 3) << name << " on " << ranks;
    }
}

TEST(Balance, LiteralStalls) {
  EXPECT_EQ(Judge(fields::dam(field_rows, field_columns), 64).run(*make("literal")).calls_to_near, 1000);
  EXPECT_GT(Judge(fields::wedge(field_rows, field_columns), 256).run(*make("literal")).steady, 1.2);
}

TEST(Balance, APrimeNumberOfRanksIsNoWorse) {
  for (const char* policy : {"quasi_newton", "hybrid"}) {
    std::array<double, 3> imbalance{};
    for (int k = 0; k < 3; ++k) {
      Judge judge(fields::wedge(field_rows, field_columns), 100 + k);
      imbalance[static_cast<std::size_t>(k)] =
          judge.run(*make(policy)).steady * judge.optimum() / judge.mean();
    }
    EXPECT_LE(imbalance[1], 1.05 * imbalance[0]) << policy;
    EXPECT_LE(imbalance[1], 1.05 * imbalance[2]) << policy;
  }
}

// A quarter of a cell a call, 600 calls.
TEST(Balance, FollowsAMovingFront) {
  constexpr std::int64_t side = 480;  // 8 x 8 parts
  const auto mean_imbalance = [](CutPolicy& policy) {
    Judge judge(fields::dam(side, side, 0.15), 64, side, side);
    Cuts cuts = best_cuts(judge.costs, jagged_shape(64, side, side));
    double sum = 0;
    for (int n = 0; n < 600; ++n) {
      judge.costs = {side, side, fields::dam(side, side, 0.15 + 0.25 * n / side)};
      sum += judge.largest(cuts) / judge.mean() / 600;
      cuts = judge.call(policy, cuts);
    }
    return sum;
  };
  EXPECT_GT(mean_imbalance(*make_fixed()), 4);
  EXPECT_LE(mean_imbalance(*make_quasi_newton()), 1.08);
  EXPECT_LE(mean_imbalance(*make_hybrid()), 1.04);
}

TEST(Balance, OneRankOfHalfTheSpeed) {
  for (const auto& [policy, bound] : {std::pair{"quasi_newton", 1.13}, std::pair{"hybrid", 1.05}}) {
    Judge judge(fields::late_dam(field_rows, field_columns));
    judge.slowness[27] = 2;
    EXPECT_LE(judge.run(*make(policy)).steady * judge.optimum() / judge.mean(), bound) << policy;
  }
}

// Where migration costs more than balance brings, cuts rest.
TEST(Balance, RestsWhereAMoveDoesNotPay) {
  for (const char* name : {"quasi_newton", "hybrid"}) {
    Judge judge(fields::wedge(field_rows, field_columns));
    judge.noise = 0;
    const Cuts cuts = best_cuts(judge.costs, jagged_shape(64, field_rows, field_columns));
    std::vector<double> measured = part_costs(judge.costs, cuts);
    measured[20] *= 1.08;
    const Load dear{measured, {&judge.costs, 1}, 1e6}, cheap{measured, {&judge.costs, 1}, 1e-3};
    EXPECT_EQ(make(name)->next(cuts, dear, {field_rows, field_columns}), cuts) << name;
    EXPECT_NE(make(name)->next(cuts, cheap, {field_rows, field_columns}), cuts) << name;
  }
}

RC_GTEST_PROP(Balance, CutsAreLegalWhateverTheCosts, (std::uint32_t seed)) {
  std::mt19937 bits(seed);
  const int ranks = 1 + static_cast<int>(bits() % 40);
  const std::int64_t rows = 7 + bits() % 20, columns = 7 + bits() % 20;
  Cuts cuts = make_chaos(seed)->next(uniform_cuts(ranks, rows, columns), {}, {rows, columns});
  std::vector<double> cells;
  for (std::int64_t k = 0; k < rows * columns; ++k)
    cells.push_back(bits() % 3 == 0 ? 0.0 : 1.0 + static_cast<double>(bits() % 50));
  const CellCosts costs(rows, columns, cells);
  const CellGrid grid(2, {}, {rows, columns, 0}, {}, 1);
  for (const char* name : {"quasi_newton", "hybrid"}) {
    const auto policy = make(name), twin = make(name);
    for (int call = 0; call < 12; ++call) {
      std::vector<double> measured;
      for (int k = 0; k < ranks; ++k)
        measured.push_back(bits() % 4 == 0 ? 0.0 : 1e-6 * static_cast<double>(bits() % 1000));
      const Load load{measured, {&costs, 1}, 1e-3};
      const Cuts next = policy->next(cuts, load, {rows, columns});
      RC_ASSERT(next == twin->next(cuts, load, {rows, columns}));
      RC_ASSERT(JaggedPartition(grid, 0, 1, next).ranks() == ranks);
      cuts = next;
    }
  }
}

}  // namespace
