// The balancing rule of the seed report 003 (Furuichi & Nishiura), as printed: equations (1)-(3), whole
// cells, one cell a call. Every cut of a line moves by what it sees of its two neighbours alone (Jacobi).
#include <algorithm>
#include <cmath>
#include <utility>

#include "cut_line.hpp"
#include "decomp/cut_policy.hpp"

namespace decomp {

namespace {

constexpr std::int64_t width = JaggedPartition::min_width;

/// One line of parts and what it remembers of the call before.
class LiteralLine {
 public:
  [[nodiscard]] CutLine next(const CutLine& now, std::span<const double> cost, double beta,
                             double threshold) {
    const double mean = std::accumulate(cost.begin(), cost.end(), 0.0) / static_cast<double>(cost.size());
    std::vector<double> residual(now.size(), 0.0);
    for (std::size_t i = 1; i < cost.size(); ++i) residual[i] = cost[i] - cost[i - 1];  // (1)
    const bool remembers = cut_.size() == now.size();
    CutLine moved = now;
    for (std::size_t i = 1; i < cost.size(); ++i) {
      const std::int64_t step = remembers ? step_of(i, now[i], residual[i], mean, beta, threshold)
                                          : step_towards_cost(residual[i], mean, threshold);
      // moved[i-1] + width <= now[i] <= now[i+1] - width: clamping never lengthens the step
      moved[i] = std::clamp(now[i] + step, moved[i - 1] + width, now[i + 1] - width);
    }
    cut_ = now;
    residual_ = std::move(residual);
    return moved;
  }

 private:
  [[nodiscard]] std::int64_t step_of(std::size_t i, std::int64_t x, double f, double mean, double beta,
                                     double threshold) const {
    const auto dx = static_cast<double>(x - cut_[i]);
    const double jacobian = dx == 0 ? 0.0 : (f - residual_[i]) / dx;  // (3)
    if (!(jacobian < 0)) return step_towards_cost(f, mean, threshold);
    const double wanted = -beta * f / jacobian;  // (2)
    return wanted >= 1 ? 1 : wanted <= -1 ? -1 : 0;
  }

  [[nodiscard]] static std::int64_t step_towards_cost(double f, double mean, double threshold) {
    if (!(std::abs(f) > threshold * mean)) return 0;
    return f > 0 ? 1 : -1;
  }

  CutLine cut_;
  std::vector<double> residual_;
};

class Literal final : public CutPolicy {
 public:
  Literal(double beta, double threshold) : beta_(beta), threshold_(threshold) {}

  Cuts next(const Cuts& now, const Load& load, const CutLimits&) override {
    std::span<const double> cost = load.cost;
    check_costs(now, cost);
    columns_.resize(now.column.size());
    Cuts moved;
    std::vector<double> row_cost;
    for (std::size_t row = 0; row < now.column.size(); ++row) {
      const std::size_t parts = now.column[row].size() - 1;
      const auto mine = cost.first(parts);
      cost = cost.subspan(parts);
      moved.column.push_back(columns_[row].next(now.column[row], mine, beta_, threshold_));
      row_cost.push_back(std::accumulate(mine.begin(), mine.end(), 0.0) / static_cast<double>(parts));
    }
    moved.row = rows_.next(now.row, row_cost, beta_, threshold_);
    return moved;
  }

 private:
  double beta_, threshold_;
  LiteralLine rows_;
  std::vector<LiteralLine> columns_;
};

}  // namespace

std::unique_ptr<CutPolicy> make_literal(double beta, double threshold) {
  return std::make_unique<Literal>(beta, threshold);
}

}  // namespace decomp
