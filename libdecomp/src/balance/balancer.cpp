#include "decomp/balancer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "decomp/combined_reduction.hpp"
#include "decomp/timer.hpp"

namespace decomp {

namespace {

constexpr std::int64_t most_columns = 2'000'000;  // summed over all ranks in one message
constexpr double share_of_deciding = 0.01;        // of the time that is balanced
constexpr std::int64_t first_calls = 10;          // at every rebuild: from a poor start each of them pays
constexpr double least_cost = 0.05;  // [s] of a rank between calls: shorter times are mostly noise
constexpr std::int64_t longest_wait = 1000, calls_between_judgements = 20;  // rebuilds, calls

}  // namespace

Balancer::Balancer(std::unique_ptr<CutPolicy> policy, const CutLimits& limits, bool costs_seconds)
    : policy_(std::move(policy)),
      limits_(limits),
      grid_{limits.row_cells, limits.column_cells, 1},
      costs_seconds_(costs_seconds) {
  while (grid_.size() > most_columns) ++grid_.edge;
  account_.edge = grid_.edge;
}

std::vector<CellCosts> Balancer::sum_cells(const Comm& comm, const CountCells& count) const {
  const auto n = static_cast<std::size_t>(grid_.size());
  std::vector<std::int64_t> counts(2 * n, 0);
  count(grid_, std::span(counts).first(n), std::span(counts).subspan(n));
  comm.sum(std::span<std::int64_t>(counts));
  std::vector<CellCosts> cells;
  for (const std::size_t kind : {std::size_t{0}, n}) {
    const std::vector<double> cost(counts.begin() + static_cast<std::ptrdiff_t>(kind),
                                   counts.begin() + static_cast<std::ptrdiff_t>(kind + n));
    if (kind == 0 || std::ranges::any_of(cost, [](double c) { return c > 0; }))
      cells.emplace_back(grid_, cost);
  }
  return cells;
}

Cuts Balancer::first(const Comm& comm, const CountCells& count) const {
  return best_cuts(sum_cells(comm, count)[0],
                   jagged_shape(comm.size(), limits_.row_cells, limits_.column_cells));
}

void Balancer::migrated(std::int64_t rows_sent, std::int64_t rows_kept, double seconds) {
  sent_ += rows_sent;
  rows_ = rows_kept;
  migrating_ += seconds;
  account_.migrating += seconds;
}

void Balancer::judge(const Cuts& now, std::span<const CellCosts> cells) {
  const CellCosts& costs = cells.back();  // pairs, if there are any
  const std::vector<int> equal =
      jagged_shape(static_cast<int>(part_count(now)), limits_.row_cells, limits_.column_cells);
  account_.over_optimum = largest_part(costs, now) / largest_part(costs, best_cuts(costs, equal));
}

std::optional<Cuts> Balancer::next(const Comm& comm, const Cuts& now, double cost, const CountCells& count) {
  if (!policy_->uses_costs()) {
    Cuts moved = policy_->next(now, {}, limits_);
    return moved == now ? std::nullopt : std::optional(std::move(moved));
  }
  cost_ += cost;
  ++rebuilds_;
  if (--wait_ > 0) return {};
  const double start = thread_seconds();
  // The rank that came last did not wait for others: what the others waited is imbalance, not work.
  std::array<double, 2> largest{-last_seconds_, -migrating_};
  std::array<std::int64_t, 2> rows{sent_, rows_};
  max_and_sum(comm, largest, rows);
  const double deciding = -largest[0], migrating = -largest[1];
  const std::vector<double> costs = comm.all_gather(std::exchange(cost_, 0.0));
  const double mean = std::accumulate(costs.begin(), costs.end(), 0.0) / comm.size();
  account_.seconds += deciding;

  Load load{costs, {}, 0};
  // Moving as many rows as a rank has, as it went so far; rows of all ranks move at once.
  if (costs_seconds_ && mean > 0 && rows[0] > 0)
    load.price = migrating * static_cast<double>(rows[1]) / static_cast<double>(rows[0]) / mean;
  std::vector<CellCosts> cells;
  const bool judging = account_.calls % calls_between_judgements == 0;
  if (policy_->uses_cells() || (costs_seconds_ && judging)) cells = sum_cells(comm, count);
  if (judging && !cells.empty()) judge(now, cells);
  load.cells = cells;
  Cuts moved = policy_->next(now, load, limits_);

  ++account_.calls;
  const double per_rebuild = mean / static_cast<double>(std::exchange(rebuilds_, 0));
  wait_ = 1;
  if (costs_seconds_ && per_rebuild > 0 && account_.calls > first_calls)
    wait_ = std::clamp(
        static_cast<std::int64_t>(std::max(deciding / share_of_deciding, least_cost) / per_rebuild),
        std::int64_t{1}, longest_wait);
  last_seconds_ = thread_seconds() - start;
  if (moved == now) return {};
  ++account_.moves;
  return moved;
}

}  // namespace decomp
