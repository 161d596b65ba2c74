// Where the cuts go at a rebuild. A policy is a pure function of (cuts, times); what it decides can never
// change a bit of the physics, only its speed. One class each, in src/balance.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "decomp/cell_costs.hpp"
#include "decomp/partition.hpp"

namespace decomp {

struct CutLimits {
  std::int64_t row_cells;     ///< cells along the row axis
  std::int64_t column_cells;  ///< cells along the column axis
};

/// What was measured since the last call.
struct Load {
  std::span<const double> cost;  ///< of each rank: seconds of computation (no waiting), or counts
  std::span<const CellCosts> cells =
      {};            ///< what is counted in each column of cells: particles, pairs; or empty
  double price = 0;  ///< of moving one mean cost to another rank, in mean costs of a call
};

class CutPolicy {
 public:
  virtual ~CutPolicy() = default;
  /// New cuts from the present ones. The number of parts stays the same; only a policy that uses cells may
  /// change the number of columns of a row.
  [[nodiscard]] virtual Cuts next(const Cuts& now, const Load& load, const CutLimits& limits) = 0;
  [[nodiscard]] virtual bool uses_costs() const { return true; }  ///< else load may be empty
  [[nodiscard]] virtual bool uses_cells() const { return false; }
};

/// Cuts never move.
[[nodiscard]] std::unique_ptr<CutPolicy> make_fixed();

/// The seed's literal rule (003, equations (1)-(3)): residual f_i = T_{i+1} - T_i, diagonal secant Jacobian
/// J_ii = (f_i^n - f_i^{n-1}) / (x_i^n - x_i^{n-1}), dx_i = -beta f_i / J_ii, truncated to whole cells and to
/// one cell a call. Rows use the mean cost of their ranks. Where J is undefined (the cut did not move) or
/// not negative, the cut moves one cell towards the costlier side if the difference exceeds `threshold`
/// of the mean. It stalls where every neighbouring difference is below the threshold, however large their sum
/// (a long ramp of costs is a fixed point), and creeps at one cell a call: kept as the seed's baseline.
[[nodiscard]] std::unique_ptr<CutPolicy> make_literal(double beta = 0.5, double threshold = 0.02);

/// Cuts that follow the measured time without the literal rule's stall, see balance/quasi_newton.cpp:
/// residuals of grouped parts, coarse to fine; the Jacobian of a cost spread evenly over a part's cells, or
/// the seed's secant where it is near that; half of the thinner part at most per call; costs smoothed while
/// cuts rest. Cuts rest where a move would not pay.
[[nodiscard]] std::unique_ptr<CutPolicy> make_quasi_newton();

/// The cost of each cell from what is counted in it, by a fit to the measured costs, and the measured
/// slowness of the rank that has it; then the best cuts for these costs at once. Rows have their own numbers
/// of columns if `unequal_rows`.
[[nodiscard]] std::unique_ptr<CutPolicy> make_hybrid(bool unequal_rows = true);

/// Random legal cuts at each call, from a counter-based stream of `seed`: for tests.
[[nodiscard]] std::unique_ptr<CutPolicy> make_chaos(std::uint64_t seed);

/// Replays a recorded sequence; the last entry stays in force when it is used up. Throws InputError if it is
/// empty or, in next(), if an entry has another shape than the present cuts or does not fit the limits.
[[nodiscard]] std::unique_ptr<CutPolicy> make_replay(std::vector<Cuts> recorded);

/// One line of text per set of cuts: "rows 0 5 11 | 0 4 9 | 0 3 9".
[[nodiscard]] std::string to_text(const Cuts& cuts);
[[nodiscard]] Cuts cuts_from_text(const std::string& line);  ///< throws InputError saying what is wrong

}  // namespace decomp
