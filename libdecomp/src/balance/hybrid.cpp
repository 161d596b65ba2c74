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

/// Seconds of a unit of cells' cost on each rank over the mean, smoothed; a rank that has hardly anything
/// keeps what it had.
class SmoothedSlowness {
 public:
  std::span<const double> update(std::span<const double> seconds, std::span<const double> units) {
    const double all = std::accumulate(units.begin(), units.end(), 0.0);
    const double mean = std::accumulate(seconds.begin(), seconds.end(), 0.0) / all;
    if (factor_.size() != seconds.size())
      factor_.assign(seconds.size(), 1.0), seen_.assign(seconds.size(), 0);
    if (!(mean > 0)) return factor_;
    for (std::size_t k = 0; k < seconds.size(); ++k) {
      if (!(units[k] > 0.01 * all / static_cast<double>(units.size()))) continue;
      const double now = std::clamp(seconds[k] / units[k] / mean, 0.1, 10.0);
      factor_[k] += std::max(0.1, 1.0 / ++seen_[k]) * (now - factor_[k]);
    }
    return factor_;
  }

 private:
  std::vector<double> factor_;
  std::vector<int> seen_;
};

class Hybrid final : public CutPolicy {
 public:
  explicit Hybrid(bool unequal_rows) : unequal_rows_(unequal_rows) {}

  Cuts next(const Cuts& now, const Load& load, const CutLimits&) override {
    check_costs(now, load.cost);
    if (load.cells == nullptr || !(load.cells->total() > 0)) return now;
    const std::vector<double> units = part_costs(*load.cells, now);
    const Slowness slowness = slowness_.update(load.cost, units);
    const Cuts best = unequal_rows_ ? good_cuts(*load.cells, static_cast<int>(units.size()), slowness)
                                    : best_cuts(*load.cells, shape_of(now), slowness);
    const double mean = load.cells->total() / static_cast<double>(units.size());
    const double gain = largest_part(*load.cells, now, slowness) - largest_part(*load.cells, best, slowness);
    const double moves = moved_share(*load.cells, now, best);
    return gain > dead_band * mean && horizon * gain > load.price * moves * mean ? best : now;
  }

  [[nodiscard]] bool uses_cells() const override { return true; }

 private:
  bool unequal_rows_;
  SmoothedSlowness slowness_;
};

}  // namespace

std::unique_ptr<CutPolicy> make_hybrid(bool unequal_rows) { return std::make_unique<Hybrid>(unequal_rows); }

}  // namespace decomp
