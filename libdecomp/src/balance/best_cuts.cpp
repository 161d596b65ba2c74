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

/// The first line in [low, high] for which fits() is true; it is for high and, once true, stays so.
template <class Fits>
std::int64_t first_that(std::int64_t low, std::int64_t high, Fits fits) {
  while (low < high) {
    const std::int64_t middle = low + (high - low) / 2;
    if (fits(middle))
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

/// Of a line filled from the left, each part as wide as fits(part, first, last) allows, one without the thin
/// parts that are left over at its end: each cut as near to wanted(cut) as the parts beside it allow. The
/// line itself where that leads nowhere (a thin part may yet be too much for a slow rank).
template <class Fits, class Wanted>
CutLine evened(const CutLine& filled, Fits fits, Wanted wanted) {
  CutLine line = filled;
  for (std::size_t k = line.size() - 2; k > 0; --k) {
    const std::int64_t high = std::min(line[k], line[k + 1] - width), end = line[k + 1];
    const std::int64_t low = first_that(static_cast<std::int64_t>(k) * width, high,
                                        [&](std::int64_t first) { return fits(k, first, end); });
    line[k] = std::clamp(wanted(k), low, high);
    if (!fits(k, line[k], end)) return filled;
  }
  return fits(std::size_t{0}, 0, line[1]) ? line : filled;
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
    if (slowness.empty()) return last - first;
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
  [[nodiscard]] std::optional<CutLine> fill(int parts, double most) const {
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

  /// The same with costs as even as `most` allows.
  [[nodiscard]] std::optional<CutLine> cut(int parts, double most) const {
    std::optional<CutLine> line = fill(parts, most);
    if (!line) return line;
    const std::int64_t cells = problem.costs.columns();
    const double whole = problem.costs.sum(r0, r1, 0, cells), speed = problem.speed(rank, rank + parts);
    return evened(
        *line,
        [&](std::size_t k, std::int64_t c0, std::int64_t c1) {
          return cost(static_cast<int>(k), c0, c1) <= most;
        },
        [&](std::size_t k) {
          const double before = whole * problem.speed(rank, rank + static_cast<int>(k)) / speed;
          return last_that(0, cells,
                           [&](std::int64_t c) { return problem.costs.sum(r0, r1, 0, c) <= before; });
        });
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

/// What cuts_for() gives for the smallest bottleneck between low and most, or for most, whatever that is.
template <class CutsFor>
auto bisect(double low, double most, double tolerance, CutsFor cuts_for) {
  double high = low;
  auto best = cuts_for(high);
  for (double step = 0.01 * low; !best; step *= 2) {
    if (high >= most) return best;
    low = high;
    high = std::min(high + step, most);
    best = cuts_for(high);
  }
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

/// All rows, each as wide as its columns allow, or nothing.
std::optional<CutLine> fill_rows(const Problem& problem, std::span<const int> shape, double most) {
  CutLine row{0};
  int rank = 0;
  for (std::size_t p = 0; p < shape.size(); ++p) {
    const std::int64_t first = row.back();
    const auto left = static_cast<std::int64_t>(shape.size() - 1 - p);
    const auto fits = [&](std::int64_t last) {
      return Stripe{problem, first, last, rank}.fill(shape[p], most).has_value();
    };
    if (!fits(left > 0 ? first + width : problem.costs.rows())) return {};
    row.push_back(left > 0 ? last_that(first + width, problem.costs.rows() - left * width, fits)
                           : problem.costs.rows());
    rank += shape[p];
  }
  return row;
}

/// Cuts with no part above `most`, if there are any, and costs as even as that allows.
std::optional<Cuts> cuts_below(const Problem& problem, std::span<const int> shape, double most) {
  std::optional<CutLine> row = fill_rows(problem, shape, most);
  if (!row) return {};
  std::vector<int> rank(shape.size() + 1, 0);
  std::partial_sum(shape.begin(), shape.end(), rank.begin() + 1);
  const std::int64_t columns = problem.costs.columns();
  const double speed = problem.speed(0, problem.parts);
  row = evened(
      *row,
      [&](std::size_t p, std::int64_t r0, std::int64_t r1) {
        return Stripe{problem, r0, r1, rank[p]}.fill(shape[p], most).has_value();
      },
      [&](std::size_t p) {
        const double before = problem.costs.total() * problem.speed(0, rank[p]) / speed;
        return last_that(0, problem.costs.rows(),
                         [&](std::int64_t r) { return problem.costs.sum(0, r, 0, columns) <= before; });
      });
  Cuts cuts{std::move(*row), {}};
  for (std::size_t p = 0; p < shape.size(); ++p)
    cuts.column.push_back(*Stripe{problem, cuts.row[p], cuts.row[p + 1], rank[p]}.cut(shape[p], most));
  return cuts;
}

/// Row cuts that give each of `rows` rows the same cost.
CutLine even_rows(const CellCosts& costs, int rows) {
  const auto below = [&](std::int64_t r) { return costs.sum(0, r, 0, costs.columns()); };
  const auto line_for = [&](double most) -> std::optional<CutLine> {
    CutLine line{0};
    for (int p = 0; p < rows; ++p) {
      const std::int64_t first = line.back(), end = costs.rows() - (rows - 1 - p) * width;
      const auto fits = [&](std::int64_t last) { return below(last) - below(first) <= most; };
      if (!fits(p + 1 < rows ? first + width : end)) return {};
      line.push_back(p + 1 < rows ? last_that(first + width, end, fits) : end);
    }
    return evened(
        line, [&](std::size_t, std::int64_t r0, std::int64_t r1) { return below(r1) - below(r0) <= most; },
        [&](std::size_t p) {
          const double wanted = costs.total() * static_cast<double>(p) / rows;
          return last_that(0, costs.rows(), [&](std::int64_t r) { return below(r) <= wanted; });
        });
  };
  return *bisect(costs.total() / rows, costs.total(), 1e-4 * costs.total() / rows, line_for);
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
  double most = 0;
  bisect(problem.least(), problem.most(), 1e-6 * problem.least(), [&](double tried) {
    const std::optional<CutLine> row = fill_rows(problem, shape, tried);
    if (row) most = tried;
    return row;
  });
  return *cuts_below(problem, shape, most);
}

Cuts good_cuts(const CellCosts& costs, int parts, Slowness slowness) {
  const Problem problem{costs, slowness, parts};
  const std::vector<int> equal = jagged_shape(parts, costs.rows(), costs.columns());
  // Searching rows and columns together takes seconds then, and gains little over one after the other.
  const bool many = parts > 2000;
  std::optional<Cuts> best;
  double least = problem.most();
  const auto keep = [&](Cuts cuts) {
    const double largest = largest_part(costs, cuts, slowness);
    if (best && !(largest < least)) return false;
    least = largest;
    best = std::move(cuts);
    return true;
  };
  if (!many) keep(best_cuts(costs, equal, slowness));
  const int rows = static_cast<int>(equal.size()), stride = std::max(1, rows / 8);
  for (int p = rows - rows / 4 - 1; p <= rows + rows / 4 + 1; p += stride) {
    if (p < 1 || p * width > costs.rows() || p > parts) continue;
    if (std::optional<Cuts> found = share_columns(problem, even_rows(costs, p))) keep(std::move(*found));
  }
  if (!best) return best_cuts(costs, equal, slowness);
  while (!many && keep(best_cuts(costs, shape_of(*best), slowness))) {
  }
  return *best;
}

}  // namespace decomp
