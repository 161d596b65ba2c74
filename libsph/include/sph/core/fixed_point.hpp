// Rounding of an increment to whole quanta: to nearest, ties to even, the same bits in scalar and SIMD form.
#pragma once

#include <bit>
#include <cstdint>

namespace sph {

/// Added to |x| < 2^51 it leaves the rounded integer in the low bits of the sum's mantissa.
inline constexpr double rounding_shift = 0x1.8p52;

/// |x| < 2^51.
[[nodiscard]] inline std::int64_t round_to_quanta(double x) {
  return static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(x + rounding_shift) -
                                   std::bit_cast<std::uint64_t>(rounding_shift));
}

/// x + way. Beyond the range it wraps around, until the guard that looks at speeds stops the run.
[[nodiscard]] inline std::int64_t moved_by(std::int64_t x, std::int64_t way) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(x) + static_cast<std::uint64_t>(way));
}

}  // namespace sph
