// Sums of forces and torques over the particles of a rigid body, in the one reduction of a step: each is counted in
// quanta of 2^-64 of a unit that follows from the scene, in three digits of 32 bits, each a sum of integers. So ranks may
// add in any order, and the sum of forces is that of what the particles feel to the last bit.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>

namespace sph {

class BodySums {
 public:
  static constexpr std::size_t digits = 3;

  /// `unit`: a power of two.
  explicit BodySums(double unit) : unit_(unit) {}

  /// Less than that many units can be added.
  static constexpr double most = 0x1p30;
  [[nodiscard]] bool holds(double x) const { return std::abs(x) < most * unit_; }  // no NaN either
  void add(double x, std::span<std::int64_t, digits> sum) const {
    double left = x / unit_;
    for (std::size_t k = 0; k + 1 < digits; ++k) {
      const double whole = std::floor(left);
      sum[k] += static_cast<std::int64_t>(whole);
      left = (left - whole) * 0x1p32;
    }
    sum[digits - 1] += static_cast<std::int64_t>(std::nearbyint(left));
  }
  [[nodiscard]] double value(std::span<const std::int64_t, digits> sum) const {
    constexpr std::int64_t mask = (std::int64_t{1} << 32) - 1;
    const std::int64_t middle = sum[1] + (sum[2] >> 32), high = sum[0] + (middle >> 32);
    return unit_ * (static_cast<double>(high) + 0x1p-32 * (static_cast<double>(middle & mask) +
                                                           0x1p-32 * static_cast<double>(sum[2] & mask)));
  }

 private:
  double unit_;
};

}  // namespace sph
