// Rounding of an increment to whole quanta: to nearest, ties to even, the same bits in scalar and SIMD form.
#pragma once

#include <bit>
#include <cstdint>

namespace sph {

/// |x| < 2^51. Adding 1.5 * 2^52 leaves the rounded integer in the low bits of the sum's mantissa.
[[nodiscard]] inline std::int64_t round_to_quanta(double x) {
  constexpr double magic = 6755399441055744.0;
  return std::bit_cast<std::int64_t>(x + magic) - std::bit_cast<std::int64_t>(magic);
}

}  // namespace sph
