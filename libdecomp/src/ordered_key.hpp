// Doubles are compared as integers of the same order. MPI_MAX on doubles would depend on the order of the
// ranks for NaN and for -0 against +0; here -0 < +0. A NaN's own key is for the caller to choose, so that a
// NaN anywhere is the result, and comes back as the one quiet NaN.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace decomp {

[[nodiscard]] inline std::int64_t ordered_key(double x) {
  const auto bits = std::bit_cast<std::int64_t>(x);
  return bits ^ ((bits >> 63) & std::numeric_limits<std::int64_t>::max());
}

[[nodiscard]] inline double from_ordered_key(std::int64_t key) {
  const auto x = std::bit_cast<double>(key ^ ((key >> 63) & std::numeric_limits<std::int64_t>::max()));
  return std::isnan(x) ? std::numeric_limits<double>::quiet_NaN() : x;
}

}  // namespace decomp
