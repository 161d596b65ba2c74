// Exact sum of doubles: a fixed-point accumulator wide enough for every finite double (Kulisch), held as
// 32-bit digits in 64-bit integers. Addition is integer addition, hence order-free: the rounded result has
// the same bits for any order, any number of ranks and any grouping. An empty sum is +0, and so is any sum
// that cancels exactly. Carries are propagated once in 2^30 additions: there is no limit on their number.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "decomp/comm.hpp"

namespace decomp {

class ExactSum {
 public:
  void add(double x);  ///< NaN or infinity make the result NaN
  void add(const ExactSum& other);
  [[nodiscard]] double value() const;  ///< nearest double to the exact sum (ties to even)

  /// Sums over all ranks, in place, in one allreduce for all of them.
  static void all_reduce(const Comm& comm, std::span<ExactSum> sums);

 private:
  /// Digit d has the weight 2^(32 d - 1074). 66 digits reach 2^1038, beyond the largest double; two more, the
  /// last of them signed, leave head room for 2^100 such terms.
  static constexpr int digits = 68;
  static constexpr std::int64_t max_pending = std::int64_t{1} << 30;
  std::array<std::int64_t, digits> digit_{};
  std::int64_t non_finite_ = 0;
  std::int64_t pending_ = 0;  ///< |digit| < 2^32 * pending for all but the last digit
  void propagate();           ///< makes every digit but the last lie in [0, 2^32)
};

}  // namespace decomp
