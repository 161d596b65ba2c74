#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "cut_line.hpp"
#include "decomp/cell_costs.hpp"

namespace decomp {
namespace {

constexpr std::int64_t width = JaggedPartition::min_width;

/// The last line in [low, high] for which fits() is true; it is for low and, once false, stays so.
template <class Fits>
std::int64_t last_that(std::int64_t low, std::int64_t high, Fits fits) {
  while (low < high) {
    const std::int64_t middle = low + (high - low + 1) / 2;
    if (fits(middle))
      low = middle;
    else
      high = middle - 1;
  }
  return low;
}

/// Cells and ranks: what a range of cells costs on a rank, and what all of it costs at best.
struct Problem {
  const CellCosts& costs;
  Slowness slowness;
  int parts;

  [[nodiscard]] double slow(int rank) const {
    return slowness.empty() ? 1.0 : slowness[static_cast<std::size_t>(rank)];
  }
  [[nodiscard]] double speed(int first, int last) const {
    double sum = 0;
    for (int k = first; k < last; ++k) sum += 1 / slow(k);
    return sum;
  }
  [[nodiscard]] double least() const { return costs.total() / speed(0, parts); }
  [[nodiscard]] double most() const {
    return costs.total() * (slowness.empty() ? 1.0 : std::ranges::max(slowness));
  }
};

/// Cells of rows [r0, r1), to be cut into columns for the ranks from `rank` on.
struct Stripe {
  const Problem& problem;
  std::int64_t r0, r1;
  int rank;

  [[nodiscard]] double cost(int part, std::int64_t c0, std::int64_t c1) const {
    return problem.costs.sum(r0, r1, c0, c1) * problem.slow(rank + part);
  }

  /// Cuts into `parts` of at most `most` each, filled from the left, or nothing.
  [[nodiscard]] std::optional<CutLine> cut(int parts, double most) const {
    const std::int64_t cells = problem.costs.columns();
    CutLine line{0};
    for (int k = 0; k + 1 < parts; ++k) {
      const std::int64_t first = line.back();
      if (cost(k, first, first + width) > most) return {};
      line.push_back(last_that(first + width, cells - (parts - 1 - k) * width,
                               [&](std::int64_t c) { return cost(k, first, c) <= most; }));
    }
    if (cost(parts - 1, line.back(), cells) > most) return {};
    line.push_back(cells);
    return line;
  }

  /// How many parts of at most `most` it takes; more than `limit` counts as limit + 1.
  [[nodiscard]] int parts_for(double most, int limit) const {
    const std::int64_t cells = problem.costs.columns();
    std::int64_t first = 0;
    int parts = 0;
    for (; first < cells; ++parts) {
      if (parts == limit || cost(parts, first, first + width) > most) return limit + 1;
      first = last_that(first + width, cells, [&](std::int64_t c) { return cost(parts, first, c) <= most; });
    }
    return parts;
  }
};

/// What cuts_for() gives for the smallest bottleneck between low and high; it gives something for high.
template <class CutsFor>
auto bisect(double low, double high, double tolerance, CutsFor cuts_for) {
  auto best = cuts_for(high);
  while (high - low > tolerance) {
    const double middle = 0.5 * (low + high);
    if (auto found = cuts_for(middle)) {
      best = std::move(found);
      high = middle;
    } else {
      low = middle;
    }
  }
  return best;
}

/// All rows, each as wide as its columns allow.
std::optional<Cuts> fill(const Problem& problem, std::span<const int> shape, double most) {
  Cuts cuts{{0}, {}};
  int rank = 0;
  for (std::size_t p = 0; p < shape.size(); ++p) {
    const std::int64_t first = cuts.row.back();
    const auto left = static_cast<std::int64_t>(shape.size() - 1 - p);
    const auto columns_to = [&](std::int64_t last) {
      return Stripe{problem, first, last, rank}.cut(shape[p], most);
    };
    std::int64_t last = problem.costs.rows();
    if (left > 0) {
      if (!columns_to(first + width)) return {};
      last = last_that(first + width, last - left * width,
                       [&](std::int64_t r) { return columns_to(r).has_value(); });
    }
    std::optional<CutLine> columns = columns_to(last);
    if (!columns) return {};
    cuts.row.push_back(last);
    cuts.column.push_back(std::move(*columns));
    rank += shape[p];
  }
  return cuts;
}

/// Row cuts that give each of `rows` rows the same cost.
CutLine even_rows(const CellCosts& costs, int rows) {
  const CellCosts* c = &costs;
  const auto cuts_for = [&](double most) -> std::optional<CutLine> {
    CutLine line{0};
    for (int p = 0; p + 1 < rows; ++p) {
      const std::int64_t first = line.back();
      if (c->sum(first, first + width, 0, c->columns()) > most) return {};
      line.push_back(last_that(first + width, c->rows() - (rows - 1 - p) * width,
                               [&](std::int64_t r) { return c->sum(first, r, 0, c->columns()) <= most; }));
    }
    if (c->sum(line.back(), c->rows(), 0, c->columns()) > most) return {};
    line.push_back(c->rows());
    return line;
  };
  return *bisect(costs.total() / rows, costs.total(), 1e-4 * costs.total() / rows, cuts_for);
}

/// For given rows the numbers of columns, and the columns, that make the bottleneck least.
std::optional<Cuts> share_columns(const Problem& problem, const CutLine& row) {
  const std::size_t rows = row.size() - 1;
  const auto counts_for = [&](double most) -> std::optional<std::vector<int>> {
    std::vector<int> count;
    int used = 0;
    for (std::size_t p = 0; p < rows; ++p) {
      count.push_back(Stripe{problem, row[p], row[p + 1], used}.parts_for(most, problem.parts - used));
      if ((used += count.back()) > problem.parts) return {};
    }
    return count;
  };
  std::optional<std::vector<int>> count =
      bisect(problem.least(), problem.most(), 1e-3 * problem.least(), counts_for);
  if (!count) return {};
  // Ranks left over go where a part costs most in the mean.
  for (int used = std::accumulate(count->begin(), count->end(), 0); used < problem.parts; ++used) {
    std::optional<std::size_t> dearest;
    double most = -1;
    for (std::size_t p = 0; p < rows; ++p) {
      const double mean = problem.costs.sum(row[p], row[p + 1], 0, problem.costs.columns()) / (*count)[p];
      if (((*count)[p] + 1) * width <= problem.costs.columns() && mean > most) most = mean, dearest = p;
    }
    if (!dearest) return {};
    ++(*count)[*dearest];
  }
  Cuts cuts{row, {}};
  int rank = 0;
  for (std::size_t p = 0; p < rows; ++p) {
    const Stripe stripe{problem, row[p], row[p + 1], rank};
    const double whole = problem.costs.sum(row[p], row[p + 1], 0, problem.costs.columns());
    const double least = whole / problem.speed(rank, rank + (*count)[p]);
    cuts.column.push_back(*bisect(least, problem.most(), 1e-4 * problem.least(),
                                  [&](double most) { return stripe.cut((*count)[p], most); }));
    rank += (*count)[p];
  }
  return cuts;
}

}  // namespace

Cuts best_cuts(const CellCosts& costs, std::span<const int> shape, Slowness slowness) {
  const Problem problem{costs, slowness, std::accumulate(shape.begin(), shape.end(), 0)};
  bool fits = static_cast<std::int64_t>(shape.size()) * width <= costs.rows();
  for (const int columns : shape) fits = fits && columns * width <= costs.columns();
  if (!fits) throw InputError("the parts do not fit the cells");
  return *bisect(problem.least(), problem.most(), 1e-6 * problem.least(),
                 [&](double most) { return fill(problem, shape, most); });
}

Cuts good_cuts(const CellCosts& costs, int parts, Slowness slowness) {
  const Problem problem{costs, slowness, parts};
  const std::vector<int> equal = jagged_shape(parts, costs.rows(), costs.columns());
  Cuts best = best_cuts(costs, equal, slowness);
  double least = largest_part(costs, best, slowness);
  const auto keep = [&](Cuts cuts) {
    const double largest = largest_part(costs, cuts, slowness);
    if (!(largest < least)) return false;
    least = largest;
    best = std::move(cuts);
    return true;
  };
  const int rows = static_cast<int>(equal.size());
  for (int p = std::max(1, rows - rows / 4 - 1); p <= rows + rows / 4 + 1; ++p) {
    if (p * width > costs.rows() || p > parts) continue;
    if (std::optional<Cuts> found = share_columns(problem, even_rows(costs, p))) keep(std::move(*found));
  }
  while (keep(best_cuts(costs, shape_of(best), slowness))) {
  }
  return best;
}

}  // namespace decomp
