// Costs of cells from what their particles should cost, times the measured speed of the rank that has them,
// and the best jagged partition of those costs at once.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "cut_line.hpp"
#include "decomp/cut_policy.hpp"

namespace decomp {

namespace {

constexpr double horizon = 20;       // calls over which a move should pay
constexpr double dead_band = 0.004;  // of the mean cost

/// Seconds of a unit of cells' cost on each rank over the mean, smoothed: a call counts by the seconds it
/// covers, since short ones are noise, and by a tenth at least where it is the longest so far. A rank that
/// has hardly anything keeps what it had.
class SmoothedSlowness {
 public:
  std::span<const double> update(std::span<const double> seconds, std::span<const double> units) {
    const double all = std::accumulate(units.begin(), units.end(), 0.0);
    const double sum = std::accumulate(seconds.begin(), seconds.end(), 0.0), mean = sum / all;
    if (factor_.size() != seconds.size())
      factor_.assign(seconds.size(), 1.0), covered_.assign(seconds.size(), 0.0);
    if (!(mean > 0)) return factor_;
    longest_ = std::max(longest_, sum);
    for (std::size_t k = 0; k < seconds.size(); ++k) {
      if (!(units[k] > 0.01 * all / static_cast<double>(units.size()))) continue;
      const double now = std::clamp(seconds[k] / units[k] / mean, 0.1, 10.0);
      covered_[k] = std::min(covered_[k] + sum, 10 * longest_);
      factor_[k] += sum / covered_[k] * (now - factor_[k]);
    }
    return factor_;
  }

 private:
  std::vector<double> factor_, covered_;  ///< covered: seconds of all ranks that the factor stands for
  double longest_ = 0;
};

/// What one particle, and one pair, costs: weights of the counts by least squares over the ranks, drawn
/// towards equal shares of all counts, which decides where there are few ranks.
class Fit {
 public:
  std::span<const double> update(std::span<const double> seconds, std::span<const CellCosts> counts,
                                 const Cuts& now) {
    const double ranks = static_cast<double>(seconds.size());
    const double mean = std::accumulate(seconds.begin(), seconds.end(), 0.0) / ranks;
    if (weight_.size() != counts.size())
      share_.assign(counts.size(), 1.0 / static_cast<double>(counts.size()));
    weight_.assign(counts.size(), 1.0);
    if (counts.size() == 2 && mean > 0) {
      const std::vector<double> a = part_costs(counts[0], now), b = part_costs(counts[1], now);
      const double mean_a = counts[0].total() / ranks, mean_b = counts[1].total() / ranks;
      // Minimise sum (s x + (1 - s) y - t)^2 + pull (s - s_before)^2, all over their means.
      double up = pull * share_[0], down = pull;
      for (std::size_t k = 0; k < seconds.size(); ++k) {
        const double x = a[k] / mean_a, y = b[k] / mean_b, t = seconds[k] / mean;
        up += (x - y) * (t - y);
        down += (x - y) * (x - y);
      }
      share_[0] = std::clamp(up / down, 0.02, 0.98);
      share_[1] = 1 - share_[0];
    }
    for (std::size_t k = 0; k < counts.size(); ++k)
      if (counts[k].total() > 0) weight_[k] = share_[k] / counts[k].total();
    return weight_;
  }

 private:
  static constexpr double pull = 0.5;
  std::vector<double> share_, weight_;
};

class Hybrid final : public CutPolicy {
 public:
  explicit Hybrid(bool unequal_rows) : unequal_rows_(unequal_rows) {}

  Cuts next(const Cuts& now, const Load& load, const CutLimits&) override {
    check_costs(now, load.cost);
    if (load.cells.empty() || !(load.cells[0].total() > 0)) return now;
    const CellCosts cells(load.cells, fit_.update(load.cost, load.cells, now));
    const std::vector<double> units = part_costs(cells, now);
    const Slowness slowness = slowness_.update(load.cost, units);
    const Cuts best = unequal_rows_ ? good_cuts(cells, static_cast<int>(units.size()), slowness)
                                    : best_cuts(cells, shape_of(now), slowness);
    const double mean = cells.total() / static_cast<double>(units.size());
    const double gain = largest_part(cells, now, slowness) - largest_part(cells, best, slowness);
    const double moves = moved_share(cells, now, best);
    return gain > dead_band * mean && horizon * gain > load.price * moves * mean ? best : now;
  }

  [[nodiscard]] bool uses_cells() const override { return true; }

 private:
  bool unequal_rows_;
  Fit fit_;
  SmoothedSlowness slowness_;
};

}  // namespace

std::unique_ptr<CutPolicy> make_hybrid(bool unequal_rows) { return std::make_unique<Hybrid>(unequal_rows); }

}  // namespace decomp
