// Cuts that follow the measured time quickly and leave no ramp behind: what the literal rule lacks.
//  - Each line of cuts (the rows, then the columns of each row) is relaxed on a model, every part's cost
//    spread evenly over its cells, for groups of s = ..., 4, 2, 1 parts: f = mean cost right - mean cost left
//    of the cut between two groups, dx = -beta f / J. A long ramp is seen at the coarse levels and goes at
//    once.
//  - J is that of the model, -(rho_left + rho_right); at s = 1 times the seed's secant (003, equation (3))
//    over the model's J at the last move, where that lies in [0.2, 5].
//  - Cuts are real numbers until they are rounded, once, at the end: no residual is truncated away.
//  - A cut moves by at most half of the thinner of its two parts.
//  - Costs are filtered (Kalman, one number a part): calls with resting cuts average out the noise, and what
//    a move should have changed is predicted by the model, with less trust the more has moved.
//  - A line rests where the move would gain less than the noise or than it costs to migrate.
#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <utility>

#include "cut_line.hpp"
#include "decomp/cut_policy.hpp"

namespace decomp {

namespace {

constexpr std::int64_t width = JaggedPartition::min_width;
constexpr double least_share = 0.05;  // of the mean cost: an empty part counts as that, to have a slope
constexpr double beta = 0.5;
constexpr double dead_band = 0.004;  // of the mean cost
constexpr double horizon = 20;       // calls over which a move should pay

struct Span {
  std::size_t first, last;
};

/// Parts of a line that [lo, hi) meets.
Span parts_meeting(const CutLine& line, std::int64_t lo, std::int64_t hi) {
  const auto first = std::upper_bound(line.begin() + 1, line.end() - 1, lo) - line.begin() - 1;
  const auto last = std::lower_bound(line.begin() + 1, line.end() - 1, hi) - line.begin();
  return {static_cast<std::size_t>(first), static_cast<std::size_t>(last)};
}

double overlap(std::int64_t a0, std::int64_t a1, std::int64_t b0, std::int64_t b1) {
  return static_cast<double>(std::max<std::int64_t>(std::min(a1, b1) - std::max(a0, b0), 0));
}

/// What a part of other cuts would cost if every part's cost is spread evenly over its cells.
struct Predicted {
  double cost = 0;
  double gained = 0;    ///< the part of it that another rank has now
  double in_doubt = 0;  ///< cells that come or go, were they as dear as those of the dearest part around
};

std::vector<Predicted> predict(const Cuts& before, std::span<const double> cost, const Cuts& after) {
  std::vector<std::size_t> first{0};
  for (const CutLine& column : before.column) first.push_back(first.back() + column.size() - 1);
  const auto density = [&](std::size_t p, std::size_t k) {
    return cost[first[p] + k] / static_cast<double>((before.row[p + 1] - before.row[p]) *
                                                    (before.column[p][k + 1] - before.column[p][k]));
  };
  std::vector<Predicted> out;
  for (std::size_t r = 0; r < after.column.size(); ++r) {
    const std::int64_t r0 = after.row[r], r1 = after.row[r + 1];
    const Span rows = parts_meeting(before.row, r0 - 1, r1 + 1);
    for (std::size_t c = 0; c + 1 < after.column[r].size(); ++c) {
      const std::int64_t c0 = after.column[r][c], c1 = after.column[r][c + 1];
      Predicted part;
      double dearest = 0;
      for (std::size_t p = rows.first; p < rows.last; ++p) {
        const double high = overlap(before.row[p], before.row[p + 1], r0, r1);
        const CutLine& line = before.column[p];
        const Span columns = parts_meeting(line, c0 - 1, c1 + 1);
        for (std::size_t k = columns.first; k < columns.last; ++k) {
          part.cost += density(p, k) * high * overlap(line[k], line[k + 1], c0, c1);
          dearest = std::max(dearest, density(p, k));
        }
      }
      const CutLine& own = before.column[r];
      const double kept =
          overlap(before.row[r], before.row[r + 1], r0, r1) * overlap(own[c], own[c + 1], c0, c1);
      const auto cells = static_cast<double>((r1 - r0) * (c1 - c0) +
                                             (before.row[r + 1] - before.row[r]) * (own[c + 1] - own[c]));
      part.gained = part.cost - kept * density(r, c);
      part.in_doubt = (cells - 2 * kept) * dearest;
      out.push_back(part);
    }
  }
  return out;
}

/// One line of parts; a row counts as many parts as it has columns (`weight`).
class Line {
 public:
  Line(const CutLine& cut, std::span<const double> cost, std::vector<double> weight)
      : cut_(cut), weight_(std::move(weight)), before_(cut.size(), 0.0), parts_(weight_.size()) {
    const double mean =
        std::accumulate(cost.begin(), cost.end(), 0.0) / std::accumulate(weight_.begin(), weight_.end(), 0.0);
    for (std::size_t k = 0; k < parts_; ++k)
      before_[k + 1] = before_[k] + std::max(cost[k], least_share * mean * weight_[k]);
    for (const std::int64_t c : cut) x_.push_back(static_cast<double>(c));
  }

  /// Where the model's costs are even, as far as one call may go. `secant`: of each cut, the true slope of
  /// the residual over slope().
  [[nodiscard]] CutLine relaxed(std::span<const double> secant) {
    for (int cycle = 0; cycle < 4; ++cycle)
      for (std::size_t s = std::bit_floor(std::max<std::size_t>(parts_ - 1, 1)); s >= 1; s /= 2)
        for (int sweep = 0; sweep < 2; ++sweep) relax(s);
    CutLine moved = cut_;
    for (std::size_t i = 1; i < parts_; ++i) {
      const double now = static_cast<double>(cut_[i]), way = x_[i] - now;
      const double cells = std::abs(below(x_[i]) - before_[i]) / (dearest(i) * secant[i]);
      const double reach = 0.5 * static_cast<double>(std::min(cut_[i + 1] - cut_[i], cut_[i] - cut_[i - 1]));
      const double step = std::copysign(std::min({cells, std::abs(way), reach}), way);
      moved[i] = std::clamp(static_cast<std::int64_t>(std::lround(now + step)), moved[i - 1] + width,
                            cut_[parts_] - static_cast<std::int64_t>(parts_ - i) * width);
    }
    return moved;
  }

  /// Residual at cut i, and its slope if every cell there costs as much as in the dearer of the two parts: a
  /// part that is nearly empty may well have a full cell at its edge.
  [[nodiscard]] double residual(std::size_t i) const {
    return (before_[i + 1] - before_[i]) / weight_[i] - (before_[i] - before_[i - 1]) / weight_[i - 1];
  }
  [[nodiscard]] double slope(std::size_t i) const {
    return -dearest(i) * (1 / weight_[i - 1] + 1 / weight_[i]);
  }

  /// Costs a unit of weight after the cuts have moved: cells that cross a cut are as dear as slope() has
  /// them, but no more crosses than relaxed() wanted.
  struct Uneven {
    double largest = 0, mean_square = 0;
  };
  [[nodiscard]] Uneven uneven(const CutLine& moved) const {
    const auto crossing = [&](std::size_t i) {
      if (i == 0 || i == parts_) return 0.0;
      const double wanted = below(x_[i]) - before_[i], cells = static_cast<double>(moved[i] - cut_[i]);
      return std::copysign(std::min(std::abs(cells) * dearest(i), std::abs(wanted)), cells);
    };
    Uneven out;
    for (std::size_t k = 0; k < parts_; ++k) {
      const double cost = (before_[k + 1] - before_[k] + crossing(k + 1) - crossing(k)) / weight_[k];
      out.largest = std::max(out.largest, cost);
      out.mean_square += cost * cost / static_cast<double>(parts_);
    }
    return out;
  }

 private:
  [[nodiscard]] double below(double x) const {
    auto k = static_cast<std::size_t>(
        std::upper_bound(cut_.begin() + 1, cut_.end() - 1, static_cast<std::int64_t>(std::floor(x))) -
        cut_.begin() - 1);
    const double share = (x - static_cast<double>(cut_[k])) / static_cast<double>(cut_[k + 1] - cut_[k]);
    return before_[k] + share * (before_[k + 1] - before_[k]);
  }
  [[nodiscard]] double weight(std::size_t a, std::size_t b) const {
    return std::accumulate(weight_.begin() + static_cast<std::ptrdiff_t>(a),
                           weight_.begin() + static_cast<std::ptrdiff_t>(b), 0.0);
  }
  [[nodiscard]] double mean(std::size_t a, std::size_t b) const {
    return (below(x_[b]) - below(x_[a])) / weight(a, b);
  }
  [[nodiscard]] double density(std::size_t a, std::size_t b) const { return mean(a, b) / (x_[b] - x_[a]); }

  [[nodiscard]] double dearest(std::size_t i) const {
    return std::max((before_[i] - before_[i - 1]) / static_cast<double>(cut_[i] - cut_[i - 1]),
                    (before_[i + 1] - before_[i]) / static_cast<double>(cut_[i + 1] - cut_[i]));
  }

  /// One Jacobi sweep over the cuts between groups of s parts. Cuts within a group go along in proportion.
  void relax(std::size_t s) {
    std::vector<double> x = x_;
    for (std::size_t b = s; b < parts_; b += s) {
      const std::size_t a = b - s, c = std::min(b + s, parts_);
      const double f = mean(b, c) - mean(a, b);
      const double jacobian = -(density(a, b) + density(b, c));
      const double room = 0.4 * std::min(x_[b] - x_[a], x_[c] - x_[b]);
      x[b] += std::clamp(-beta * f / jacobian, -room, room);
    }
    for (std::size_t a = 0; a < parts_; a += s) {
      const std::size_t b = std::min(a + s, parts_);
      for (std::size_t k = a + 1; k < b; ++k) x[k] = x[a] + (x[b] - x[a]) * (x_[k] - x_[a]) / (x_[b] - x_[a]);
    }
    x_ = std::move(x);
  }

  const CutLine& cut_;
  std::vector<double> weight_;
  std::vector<double> before_;  ///< cost up to each cut
  std::vector<double> x_;
  std::size_t parts_;
};

/// The seed's secant of each cut of a line, as a factor of the model's slope.
class Secants {
 public:
  std::span<const double> update(const CutLine& cut, const Line& line, double mean) {
    const std::size_t n = cut.size();
    if (cut_.size() != n) {
      factor_.assign(n, 1.0);
    } else {
      for (std::size_t i = 1; i + 1 < n; ++i) {
        const auto dx = static_cast<double>(cut[i] - cut_[i]);
        const double ratio = (line.residual(i) - residual_[i]) / dx / slope_[i];
        if (std::abs(dx * slope_[i]) > noise_free * mean && ratio >= 0.2 && ratio <= 5)
          factor_[i] = ratio < 1 ? std::sqrt(ratio) : ratio;  // longer steps only half way
        else
          factor_[i] = 1 + 0.8 * (factor_[i] - 1);
      }
    }
    cut_ = cut;
    residual_.assign(n, 0.0);
    slope_.assign(n, -1.0);
    for (std::size_t i = 1; i + 1 < n; ++i) residual_[i] = line.residual(i), slope_[i] = line.slope(i);
    return factor_;
  }

 private:
  static constexpr double noise_free = 0.1;  // of the mean cost: what a move must have changed to be measured
  CutLine cut_;
  std::vector<double> residual_, slope_, factor_;
};

/// Costs of all parts, the noise averaged out.
class Filter {
 public:
  std::span<const double> update(const Cuts& now, std::span<const double> measured) {
    if (cost_.size() != measured.size()) {
      cost_.assign(measured.begin(), measured.end());
      variance_.assign(measured.size(), 1.0);
      missed_.assign(measured.size(), 0.0);
    } else {
      const std::vector<Predicted> predicted = predict(cuts_, cost_, now);
      for (std::size_t k = 0; k < cost_.size(); ++k) {
        const auto& [cost, gained, in_doubt] = predicted[k];
        // In units of the variance of one measurement, taken as 2 %. The model is wrong by half of the doubt,
        // and by what it has missed twice in the same sense.
        const double unit = noise * std::max({cost, least_share * in_doubt, 1e-300});
        const double wrong = 0.5 * in_doubt / unit, missed = (measured[k] - cost) / unit;
        const double again = missed * missed_[k] > 0 ? std::min(std::abs(missed), std::abs(missed_[k])) : 0.0;
        missed_[k] = missed;
        const double variance = variance_[k] + wrong * wrong + drift + std::max(0.0, again * again - 1);
        const double gain = variance / (variance + 1);
        cost_[k] = cost + gain * (measured[k] - cost);
        variance_[k] = (1 - gain) * variance;
      }
    }
    cuts_ = now;
    return cost_;
  }

 private:
  static constexpr double noise = 0.02, drift = 0.05;  // the load itself changes: the gain at rest is 0.2
  Cuts cuts_;
  std::vector<double> cost_, variance_, missed_;
};

class QuasiNewton final : public CutPolicy {
 public:
  Cuts next(const Cuts& now, const Load& load, const CutLimits&) override {
    check_costs(now, load.cost);
    const std::span<const double> cost = filter_.update(now, load.cost);
    const double mean = std::accumulate(cost.begin(), cost.end(), 0.0) / static_cast<double>(cost.size());
    if (!(mean > 0)) return now;
    Cuts moved = now;
    moved.row = next_rows(now, cost, mean);
    // The columns of the rows as they will be.
    std::vector<double> predicted;
    for (const Predicted& part : predict(now, cost, moved)) predicted.push_back(part.cost);
    columns_.resize(now.column.size());
    std::size_t first = 0;
    for (std::size_t r = 0; r < now.column.size(); ++r) {
      const std::size_t parts = now.column[r].size() - 1;
      const auto own = std::span(predicted).subspan(first, parts);
      moved.column[r] = next_line(now.column[r], own, std::vector<double>(parts, 1.0), mean, columns_[r]);
      first += parts;
    }
    return pays(now, cost, moved, mean, load.price) ? moved : now;
  }

 private:
  [[nodiscard]] CutLine next_rows(const Cuts& now, std::span<const double> cost, double mean) {
    std::vector<double> row_cost, weight;
    for (const CutLine& column : now.column) {
      const std::size_t parts = column.size() - 1;
      row_cost.push_back(
          std::accumulate(cost.begin(), cost.begin() + static_cast<std::ptrdiff_t>(parts), 0.0));
      weight.push_back(static_cast<double>(parts));
      cost = cost.subspan(parts);
    }
    return next_line(now.row, row_cost, std::move(weight), mean, rows_);
  }

  [[nodiscard]] static CutLine next_line(const CutLine& cut, std::span<const double> cost,
                                         std::vector<double> weight, double mean, Secants& secants) {
    Line line(cut, cost, std::move(weight));
    const auto now = line.uneven(cut);
    const CutLine moved = line.relaxed(secants.update(cut, line, mean));
    const auto then = line.uneven(moved);
    // Far from balance the largest part may stay for a while as large as it is.
    const double gain =
        std::max(now.largest - then.largest, std::sqrt(now.mean_square) - std::sqrt(then.mean_square));
    return gain > dead_band * mean ? moved : cut;
  }

  [[nodiscard]] static bool pays(const Cuts& now, std::span<const double> cost, const Cuts& moved,
                                 double mean, double price) {
    double gained = 0, largest = 0;
    for (const Predicted& part : predict(now, cost, moved)) {
      gained += part.gained;
      largest = std::max(largest, part.cost);
    }
    // A ramp is levelled from the middle: the largest cost may fall only later. Far from balance, go on.
    const double gain = std::ranges::max(cost) - largest;
    return price == 0 || horizon * gain > price * gained || std::ranges::max(cost) > 1.1 * mean;
  }

  Filter filter_;
  Secants rows_;
  std::vector<Secants> columns_;
};

}  // namespace

std::unique_ptr<CutPolicy> make_quasi_newton() { return std::make_unique<QuasiNewton>(); }

}  // namespace decomp
