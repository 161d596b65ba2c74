// Fixed-width vectors: 16 floats or 8 doubles in 64 bytes, whatever the machine has. The lane count is in the
// source, so SSE2, AVX2 and AVX-512 builds do the same operations on the same lanes and give the same bits.
// Never passed across a translation unit.
#pragma once

#if defined(__AVX__) || defined(__SSE2__)
#include <immintrin.h>
#endif

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace sph {

template <class T>
struct Simd;

template <class T>
struct SimdTraits;
template <>
struct SimdTraits<float> {
  typedef float Native __attribute__((vector_size(64)));
  typedef float Quarter __attribute__((vector_size(16)));
  typedef std::int32_t Int __attribute__((vector_size(64)));
  using IntScalar = std::int32_t;
};
template <>
struct SimdTraits<double> {
  typedef double Native __attribute__((vector_size(64)));
  typedef double Quarter __attribute__((vector_size(32)));
  typedef std::int64_t Int __attribute__((vector_size(64)));
  using IntScalar = std::int64_t;
};

/// Arithmetic is lane by lane; comparisons give masks for select().
template <class T>
struct Simd {
  static constexpr int lanes = 64 / static_cast<int>(sizeof(T));
  using Native = typename SimdTraits<T>::Native;
  using Int = typename SimdTraits<T>::Int;
  Native v;

  Simd() = default;
  Simd(T scalar) : v(scalar - Native{}) {}  // x - 0 is x for every x, -0.0 included
  explicit Simd(Native native) : v(native) {}
  static Simd zero() { return Simd(Native{}); }

  T operator[](int lane) const { return v[lane]; }

  friend Simd operator+(Simd a, Simd b) { return Simd(a.v + b.v); }
  friend Simd operator-(Simd a, Simd b) { return Simd(a.v - b.v); }
  friend Simd operator*(Simd a, Simd b) { return Simd(a.v * b.v); }
  friend Simd operator/(Simd a, Simd b) { return Simd(a.v / b.v); }
  friend Simd operator-(Simd a) { return Simd(-a.v); }
  Simd& operator+=(Simd b) {
    v += b.v;
    return *this;
  }
  Simd& operator-=(Simd b) {
    v -= b.v;
    return *this;
  }

  /// Where the two are equal / a < b: x, elsewhere +0.
  friend Simd where_equal(Simd a, Simd b, Simd x) { return keep(a.v == b.v, x); }
  friend Simd where_less(Simd a, Simd b, Simd x) { return keep(a.v < b.v, x); }

  friend Simd max(Simd a, Simd b) {
#if defined(__AVX512F__)
    if constexpr (sizeof(T) == 4)
      return Simd(
          std::bit_cast<Native>(_mm512_max_ps(std::bit_cast<__m512>(a.v), std::bit_cast<__m512>(b.v))));
    else
      return Simd(
          std::bit_cast<Native>(_mm512_max_pd(std::bit_cast<__m512d>(a.v), std::bit_cast<__m512d>(b.v))));
#else
    return Simd(a.v > b.v ? a.v : b.v);
#endif
  }
  friend Simd min(Simd a, Simd b) {
#if defined(__AVX512F__)
    if constexpr (sizeof(T) == 4)
      return Simd(
          std::bit_cast<Native>(_mm512_min_ps(std::bit_cast<__m512>(a.v), std::bit_cast<__m512>(b.v))));
    else
      return Simd(
          std::bit_cast<Native>(_mm512_min_pd(std::bit_cast<__m512d>(a.v), std::bit_cast<__m512d>(b.v))));
#else
    return Simd(a.v < b.v ? a.v : b.v);
#endif
  }
  friend Simd sqrt(Simd a) {
#if defined(__AVX512F__)
    if constexpr (sizeof(T) == 4)
      return Simd(std::bit_cast<Native>(_mm512_sqrt_ps(std::bit_cast<__m512>(a.v))));
    else
      return Simd(std::bit_cast<Native>(_mm512_sqrt_pd(std::bit_cast<__m512d>(a.v))));
#else
    Native r;
    for (int l = 0; l < lanes; ++l) r[l] = std::sqrt(a.v[l]);
    return Simd(r);
#endif
  }

 private:
  static Simd keep(Int mask, Simd x) { return Simd(std::bit_cast<Native>(mask & std::bit_cast<Int>(x.v))); }
};

/// Difference b - a of two rows' fixed-point coordinates, stored in the bits of Simd<T>, as a number of
/// units. Modular, hence exact while the true distance is below 2^31 (float) or 2^51 (double) units.
inline Simd<float> coordinate_difference(Simd<float> a, Simd<float> b) {
  using Int = Simd<float>::Int;
  typedef std::uint32_t Unsigned __attribute__((vector_size(64)));
  const Int d = std::bit_cast<Int>(std::bit_cast<Unsigned>(b.v) - std::bit_cast<Unsigned>(a.v));
  return Simd<float>(__builtin_convertvector(d, Simd<float>::Native));
}
inline Simd<double> coordinate_difference(Simd<double> a, Simd<double> b) {
  using Int = Simd<double>::Int;
  const Int d = std::bit_cast<Int>(b.v) - std::bit_cast<Int>(a.v);
#if defined(__AVX512DQ__)
  return Simd<double>(__builtin_convertvector(d, Simd<double>::Native));
#else
  // 1.5 * 2^52: adding |d| < 2^51 to its bits adds d to its value, exactly.
  constexpr double magic = 6755399441055744.0;
  const Int bits = d + std::bit_cast<std::int64_t>(magic);
  return Simd<double>(std::bit_cast<Simd<double>::Native>(bits) - magic);
#endif
}

/// Four consecutive values from each of `lanes` rows, transposed: out[k] lane l = row[l][k].
inline void load_transposed(const float* const* row, Simd<float>* out) {
  using Quarter = SimdTraits<float>::Quarter;
  typedef float Half __attribute__((vector_size(32)));
  using Native = Simd<float>::Native;
  Native r[4];
  for (int k = 0; k < 4; ++k) {
    Quarter q[4];
    for (int i = 0; i < 4; ++i) std::memcpy(&q[i], row[4 * i + k], sizeof(Quarter));
    const Half lo = __builtin_shufflevector(q[0], q[1], 0, 1, 2, 3, 4, 5, 6, 7);
    const Half hi = __builtin_shufflevector(q[2], q[3], 0, 1, 2, 3, 4, 5, 6, 7);
    r[k] = __builtin_shufflevector(lo, hi, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  }
  const auto unpack_low = [](Native a, Native b) {
    return __builtin_shufflevector(a, b, 0, 16, 1, 17, 4, 20, 5, 21, 8, 24, 9, 25, 12, 28, 13, 29);
  };
  const auto unpack_high = [](Native a, Native b) {
    return __builtin_shufflevector(a, b, 2, 18, 3, 19, 6, 22, 7, 23, 10, 26, 11, 27, 14, 30, 15, 31);
  };
  const Native t0 = unpack_low(r[0], r[1]), t1 = unpack_low(r[2], r[3]);
  const Native t2 = unpack_high(r[0], r[1]), t3 = unpack_high(r[2], r[3]);
  const auto low_pairs = [](Native a, Native b) {
    return __builtin_shufflevector(a, b, 0, 1, 16, 17, 4, 5, 20, 21, 8, 9, 24, 25, 12, 13, 28, 29);
  };
  const auto high_pairs = [](Native a, Native b) {
    return __builtin_shufflevector(a, b, 2, 3, 18, 19, 6, 7, 22, 23, 10, 11, 26, 27, 14, 15, 30, 31);
  };
  out[0].v = low_pairs(t0, t1);
  out[1].v = high_pairs(t0, t1);
  out[2].v = low_pairs(t2, t3);
  out[3].v = high_pairs(t2, t3);
}
inline void load_transposed(const double* const* row, Simd<double>* out) {
  using Quarter = SimdTraits<double>::Quarter;
  using Native = Simd<double>::Native;
  Native r[4];
  for (int k = 0; k < 4; ++k) {
    Quarter a, b;
    std::memcpy(&a, row[k], sizeof(Quarter));
    std::memcpy(&b, row[k + 4], sizeof(Quarter));
    r[k] = __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
  }
  const Native t0 = __builtin_shufflevector(r[0], r[1], 0, 8, 2, 10, 4, 12, 6, 14);
  const Native t1 = __builtin_shufflevector(r[0], r[1], 1, 9, 3, 11, 5, 13, 7, 15);
  const Native t2 = __builtin_shufflevector(r[2], r[3], 0, 8, 2, 10, 4, 12, 6, 14);
  const Native t3 = __builtin_shufflevector(r[2], r[3], 1, 9, 3, 11, 5, 13, 7, 15);
  out[0].v = __builtin_shufflevector(t0, t2, 0, 1, 8, 9, 4, 5, 12, 13);
  out[1].v = __builtin_shufflevector(t1, t3, 0, 1, 8, 9, 4, 5, 12, 13);
  out[2].v = __builtin_shufflevector(t0, t2, 2, 3, 10, 11, 6, 7, 14, 15);
  out[3].v = __builtin_shufflevector(t1, t3, 2, 3, 10, 11, 6, 7, 14, 15);
}

}  // namespace sph
