// Smoothing kernels W(r) = alpha_D / h^D w(q), q = r / h, as templates over the arithmetic type: double,
// float or a SIMD class with + - * /, a constructor from a scalar and a free max(V, V) in its own namespace.
//   Quintic      (3-q)^5 - 6 (2-q)^5 + 15 (1-q)^5, each power clamped     Morris et al. (1997), support 3 h
//   WendlandC2   (1-q/2)^4 (1 + 2q);              1D (1-q/2)^3 (1 + 3q/2)           Wendland (1995), 2 h
//   WendlandC4   (1-q/2)^6 (1 + 3q + 35/12 q^2);  1D (1-q/2)^5 (1 + 5q/2 + 2q^2)
// The Wendland functions are multiplied by powers of two and small integers so that every coefficient is
// exact in float too; `normalisation` undoes that. Nothing branches: max ends the support, so value and slope
// are exactly 0 from `radius` on, for any finite q, and slope is exactly 0 at q = 0. A NaN stays a NaN
// provided that max(NaN, 0) is one, as with std::max. The association is written out: it is part of the
// result.
#pragma once

#include <algorithm>
#include <numbers>

namespace sph {

namespace kernel_detail {

template <class V>
[[nodiscard]] constexpr V positive_part(V x) {
  using std::max;
  return max(x, V(0.0));
}

/// One of three constants: for D = 1, 2, 3.
template <int D>
[[nodiscard]] consteval double by_dimension(double one, double two, double three) {
  static_assert(D >= 1 && D <= 3);
  return D == 1 ? one : (D == 2 ? two : three);
}

}  // namespace kernel_detail

struct Quintic {
  static constexpr double radius = 3;  ///< support in units of h
  template <int D>
  static constexpr double normalisation = kernel_detail::by_dimension<D>(
      1.0 / 120.0, 7.0 / (478.0 * std::numbers::pi), 1.0 / (120.0 * std::numbers::pi));  ///< alpha_D

  template <int D, class V>
  [[nodiscard]] static constexpr V value(V q) {
    const V a = kernel_detail::positive_part(V(3.0) - q);
    const V b = kernel_detail::positive_part(V(2.0) - q);
    const V c = kernel_detail::positive_part(V(1.0) - q);
    const V a2 = a * a, b2 = b * b, c2 = c * c;
    return ((a2 * a2) * a - V(6.0) * ((b2 * b2) * b)) + V(15.0) * ((c2 * c2) * c);
  }

  /// dw/dq
  template <int D, class V>
  [[nodiscard]] static constexpr V slope(V q) {
    const V a = kernel_detail::positive_part(V(3.0) - q);
    const V b = kernel_detail::positive_part(V(2.0) - q);
    const V c = kernel_detail::positive_part(V(1.0) - q);
    const V a2 = a * a, b2 = b * b, c2 = c * c;
    return V(-5.0) * ((a2 * a2 - V(6.0) * (b2 * b2)) + V(15.0) * (c2 * c2));
  }
};

// With s = max(2 - q, 0) the polynomials are functions of s alone, bounded however large q is. The slopes
// keep their factor q, which carries the relative accuracy near the centre, and take s in before anything
// overflows.

struct WendlandC2 {
  static constexpr double radius = 2;  ///< support in units of h
  template <int D>
  static constexpr double normalisation = kernel_detail::by_dimension<D>(
      5.0 / 128.0, 7.0 / (64.0 * std::numbers::pi), 21.0 / (256.0 * std::numbers::pi));  ///< alpha_D

  template <int D, class V>
  [[nodiscard]] static constexpr V value(V q) {
    const V s = kernel_detail::positive_part(V(2.0) - q);
    const V s2 = s * s;
    if constexpr (D == 1) return (V(8.0) - V(3.0) * s) * (s2 * s);
    return (V(5.0) - V(2.0) * s) * (s2 * s2);
  }

  /// dw/dq = -12 q s^2 in 1D, -10 q s^3 otherwise
  template <int D, class V>
  [[nodiscard]] static constexpr V slope(V q) {
    const V s = kernel_detail::positive_part(V(2.0) - q);
    if constexpr (D == 1) return (q * s) * (V(-12.0) * s);
    return (q * s) * (V(-10.0) * (s * s));
  }
};

struct WendlandC4 {
  static constexpr double radius = 2;  ///< support in units of h
  template <int D>
  static constexpr double normalisation = kernel_detail::by_dimension<D>(
      3.0 / 256.0, 3.0 / (1024.0 * std::numbers::pi), 165.0 / (65536.0 * std::numbers::pi));  ///< alpha_D

  template <int D, class V>
  [[nodiscard]] static constexpr V value(V q) {
    const V s = kernel_detail::positive_part(V(2.0) - q);
    const V s2 = s * s;
    if constexpr (D == 1) return ((V(4.0) * s - V(21.0)) * s + V(28.0)) * ((s2 * s2) * s);
    return ((V(35.0) * s - V(176.0)) * s + V(224.0)) * ((s2 * s2) * s2);
  }

  /// dw/dq = -14 q (1 + 2q) s^4 in 1D, -56 q (2 + 5q) s^5 otherwise
  template <int D, class V>
  [[nodiscard]] static constexpr V slope(V q) {
    const V s = kernel_detail::positive_part(V(2.0) - q);
    const V s2 = s * s;
    if constexpr (D == 1) return (q * s) * (((V(28.0) * s - V(70.0)) * s) * s2);
    return (q * s) * ((V(280.0) * s - V(672.0)) * (s2 * s2));
  }
};

}  // namespace sph
