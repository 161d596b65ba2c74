// Asks a cut policy as often as it pays, with what it needs, and keeps the account.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "decomp/cell_costs.hpp"
#include "decomp/comm.hpp"
#include "decomp/cut_policy.hpp"

namespace decomp {

struct BalanceAccount {
  std::int64_t calls = 0, moves = 0;  ///< of the policy; those that moved cuts
  double seconds = 0;                 ///< spent on deciding, without waiting for others
  double migrating = 0;               ///< seconds of this rank in migration, with waiting
  /// Largest part over that of the best cuts with equal numbers of columns, on the costs of cells; when it
  /// was last looked at. 0: never.
  double over_optimum = 0;
  std::int64_t edge = 1;  ///< cells that were taken as one column, along both axes
};

class Balancer {
 public:
  /// Adds this rank's particles, and their pairs, to the column of each: arrays of grid.size().
  using CountCells = std::function<void(const CellColumns& grid, std::span<std::int64_t> particles,
                                        std::span<std::int64_t> pairs)>;

  /// `costs_seconds`: costs are times. Then the policy is asked so seldom that deciding takes less than 1 %
  /// of them, and moves are weighed against the time of migration.
  Balancer(std::unique_ptr<CutPolicy> policy, const CutLimits& limits, bool costs_seconds);

  [[nodiscard]] bool follows_load() const { return policy_->uses_costs(); }

  /// The best cuts for the numbers of particles, before any time was measured. Collective.
  [[nodiscard]] Cuts first(const Comm& comm, const CountCells& count) const;

  /// Cuts to move to, if any, from the cost of this rank since the last call. Collective.
  [[nodiscard]] std::optional<Cuts> next(const Comm& comm, const Cuts& now, double cost,
                                         const CountCells& count);

  /// What the last migration took.
  void migrated(std::int64_t rows_sent, std::int64_t rows_kept, double seconds);

  [[nodiscard]] const BalanceAccount& account() const { return account_; }

 private:
  [[nodiscard]] std::vector<CellCosts> sum_cells(const Comm& comm, const CountCells& count) const;
  void judge(const Cuts& now, std::span<const CellCosts> cells);

  std::unique_ptr<CutPolicy> policy_;
  CutLimits limits_;
  CellColumns grid_;
  bool costs_seconds_;
  BalanceAccount account_;
  double cost_ = 0;            ///< since the last call
  std::int64_t rebuilds_ = 0;  ///< since then
  std::int64_t wait_ = 1;      ///< rebuilds until the next
  double last_seconds_ = 0;    ///< of the last call, on this rank
  double migrating_ = 0;       ///< seconds, on this rank
  std::int64_t sent_ = 0, rows_ = 0;
};

}  // namespace decomp
