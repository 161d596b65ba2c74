// Fixed-width vectors: 16 floats or 8 doubles in 64 bytes, whatever the machine has. The lane count is in the
// source, so SSE2, AVX2 and AVX-512 builds do the same operations on the same lanes and give the same bits.
// Never passed across a translation unit.
#pragma once

#if defined(__AVX2__)
// GCC 12 warns about its own _mm512_undefined (bug 105593).
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wuninitialized"
#include <immintrin.h>
#pragma GCC diagnostic pop
#endif

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "sph/core/fixed_point.hpp"

namespace sph {

#if defined(__AVX512F__)
inline constexpr int register_bytes = 64;
#elif defined(__AVX2__)
inline constexpr int register_bytes = 32;
#else
inline constexpr int register_bytes = 16;
#endif

template <class T>
struct Simd;

template <class T>
struct SimdTraits;
template <>
struct SimdTraits<float> {
  typedef float Native __attribute__((vector_size(64)));
  typedef std::int32_t Int __attribute__((vector_size(64)));
  using IntScalar = std::int32_t;
};
template <>
struct SimdTraits<double> {
  typedef double Native __attribute__((vector_size(64)));
  typedef std::int64_t Int __attribute__((vector_size(64)));
  using IntScalar = std::int64_t;
};

/// 64 bytes in pieces that registers hold: g++ does arithmetic on what is longer piece by piece, but compares, chooses and
/// converts it lane by lane.
template <class T>
struct Pieces {
  typedef T Piece __attribute__((vector_size(register_bytes)));
  static constexpr int count = 64 / register_bytes;
  Piece piece[count];
};

/// Arithmetic is lane by lane; comparisons give masks for select().
template <class T>
struct Simd {
  static constexpr int lanes = 64 / static_cast<int>(sizeof(T));
  using Native = typename SimdTraits<T>::Native;
  using Int = typename SimdTraits<T>::Int;
  Native v;

  Simd() = default;
  Simd(T scalar) : v(spread(scalar)) {}
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
  friend Simd where_equal(Simd a, Simd b, Simd x) {
    return piecewise([](auto p, auto q, auto y) { return keep(p == q, y); }, a, b, x);
  }
  friend Simd where_less(Simd a, Simd b, Simd x) {
    return piecewise([](auto p, auto q, auto y) { return keep(p < q, y); }, a, b, x);
  }

  friend Simd max(Simd a, Simd b) {
#if defined(__AVX512F__)
    if constexpr (sizeof(T) == 4)
      return Simd(
          std::bit_cast<Native>(_mm512_max_ps(std::bit_cast<__m512>(a.v), std::bit_cast<__m512>(b.v))));
    else
      return Simd(
          std::bit_cast<Native>(_mm512_max_pd(std::bit_cast<__m512d>(a.v), std::bit_cast<__m512d>(b.v))));
#else
    return piecewise([](auto x, auto y) { return x > y ? x : y; }, a, b);
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
    return piecewise([](auto x, auto y) { return x < y ? x : y; }, a, b);
#endif
  }
  friend Simd sqrt(Simd a) {
#if defined(__AVX512F__)
    if constexpr (sizeof(T) == 4)
      return Simd(std::bit_cast<Native>(_mm512_sqrt_ps(std::bit_cast<__m512>(a.v))));
    else
      return Simd(std::bit_cast<Native>(_mm512_sqrt_pd(std::bit_cast<__m512d>(a.v))));
#elif defined(__AVX2__)
    return piecewise(
        [](auto x) {
          if constexpr (sizeof(T) == 4)
            return std::bit_cast<decltype(x)>(_mm256_sqrt_ps(std::bit_cast<__m256>(x)));
          else
            return std::bit_cast<decltype(x)>(_mm256_sqrt_pd(std::bit_cast<__m256d>(x)));
        },
        a);
#else
    Native r;
    for (int l = 0; l < lanes; ++l) r[l] = std::sqrt(a.v[l]);
    return Simd(r);
#endif
  }

 private:
  [[gnu::always_inline]] static Native spread(T scalar) {
    Pieces<T> out;
    // x - 0 is x for every x, -0.0 included
    for (int k = 0; k < Pieces<T>::count; ++k) out.piece[k] = scalar - typename Pieces<T>::Piece{};
    return std::bit_cast<Native>(out);
  }
  template <class Mask, class Piece>
  [[gnu::always_inline]] static Piece keep(Mask mask, Piece x) {
    return std::bit_cast<Piece>(mask & std::bit_cast<Mask>(x));
  }
  template <class Function, class... More>
  [[gnu::always_inline]] static Simd piecewise(Function&& function, More... of) {
    return pieces_of(function, std::bit_cast<Pieces<T>>(of.v)...);
  }
  template <class Function, class... More>
  [[gnu::always_inline]] static Simd pieces_of(Function&& function, const More&... of) {
    Pieces<T> out;
    for (int k = 0; k < Pieces<T>::count; ++k) out.piece[k] = function(of.piece[k]...);
    return Simd(std::bit_cast<Native>(out));
  }
};

/// Difference b - a of two rows' fixed-point coordinates, stored in the bits of Simd<T>, as a number of
/// units. Modular, hence exact while the true distance is below 2^31 (float) or 2^51 (double) units.
inline Simd<float> coordinate_difference(Simd<float> a, Simd<float> b) {
  using Int = Simd<float>::Int;
  typedef std::uint32_t Unsigned __attribute__((vector_size(64)));
  const Int d = std::bit_cast<Int>(std::bit_cast<Unsigned>(b.v) - std::bit_cast<Unsigned>(a.v));
  const auto pieces = std::bit_cast<Pieces<std::int32_t>>(d);
  Pieces<float> out;
  for (int k = 0; k < out.count; ++k)
    out.piece[k] = __builtin_convertvector(pieces.piece[k], Pieces<float>::Piece);
  return Simd<float>(std::bit_cast<Simd<float>::Native>(out));
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

/// Difference b - a of two stored coordinates, stored like them.
inline Simd<float> stored_difference(Simd<float> a, Simd<float> b) {
  typedef std::uint32_t Unsigned __attribute__((vector_size(64)));
  return Simd<float>(
      std::bit_cast<Simd<float>::Native>(std::bit_cast<Unsigned>(b.v) - std::bit_cast<Unsigned>(a.v)));
}
inline Simd<double> stored_difference(Simd<double> a, Simd<double> b) {
  using Int = Simd<double>::Int;
  return Simd<double>(std::bit_cast<Simd<double>::Native>(std::bit_cast<Int>(b.v) - std::bit_cast<Int>(a.v)));
}

using Int64x8 = SimdTraits<double>::Int;

}  // namespace sph
