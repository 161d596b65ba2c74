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
#include <functional>
#include <type_traits>
#include <utility>

#include "sph/core/fixed_point.hpp"

namespace sph {

#if defined(__AVX512F__)
inline constexpr int register_bytes = 64;
#elif defined(__AVX2__)
inline constexpr int register_bytes = 32;
#else
inline constexpr int register_bytes = 16;
#endif

/// Sixteen floats, eight doubles, or as many integers, in pieces that registers hold. A vector type longer than a register would
/// be one line where this is many, but g++ keeps such vectors in memory, and compares, chooses and converts them lane by
/// lane. Arithmetic is lane by lane; comparisons give masks, 0 or -1 in each lane.
template <class T, int bytes = 64>
struct Simd {
  typedef T Piece __attribute__((vector_size(register_bytes)));
  static constexpr int lanes = bytes / static_cast<int>(sizeof(T));
  static constexpr int pieces = bytes / register_bytes, piece_lanes = lanes / pieces;
  using Bits = std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>;
  using Int = Simd<Bits, bytes>;
  Piece piece[pieces];

  Simd() = default;
  [[gnu::always_inline]] Simd(T scalar) {
    // x - 0 is x for every x, -0.0 included
    for_pieces([&](int k) { piece[k] = scalar - Piece{}; });
  }
  static Simd zero() { return Simd(T{}); }
  /// From memory, however aligned.
  [[gnu::always_inline]] static Simd load(const T* from) {
    Simd out;
    for_pieces([&](int k) { std::memcpy(&out.piece[k], from + k * piece_lanes, sizeof(Piece)); });
    return out;
  }
  [[gnu::always_inline]] void store(T* to) const {
    for_pieces([&](int k) { std::memcpy(to + k * piece_lanes, &piece[k], sizeof(Piece)); });
  }
  /// From registers as intrinsics have them, and back.
  template <class... Register>
  [[gnu::always_inline]] static Simd of(Register... r) {
    static_assert(sizeof...(Register) == pieces);
    return Simd{from_pieces{}, std::bit_cast<Piece>(r)...};
  }
  template <class Register>
  [[gnu::always_inline]] Register as(int k = 0) const {
    return std::bit_cast<Register>(piece[k]);
  }

  [[gnu::always_inline]] T operator[](int lane) const {
    return piece[lane / piece_lanes][lane % piece_lanes];
  }
  [[gnu::always_inline]] void set(int lane, T x) { piece[lane / piece_lanes][lane % piece_lanes] = x; }

  /// function(piece, those of others ...) of every piece.
  template <class To = T, class Function, class... More>
  [[gnu::always_inline]] Simd<To, bytes> each(Function function, const More&... more) const {
    Simd<To, bytes> out;
    for_pieces([&](int k) {
      // clang's masks are of long long
      out.piece[k] = std::bit_cast<typename Simd<To, bytes>::Piece>(function(piece[k], more.piece[k]...));
    });
    return out;
  }
  /// The same bits in lanes of another type.
  template <class To>
  [[gnu::always_inline]] Simd<To, bytes> bits() const {
    return each<To>([](Piece x) { return x; });
  }

  friend Simd operator+(Simd a, Simd b) { return a.each(std::plus<>{}, b); }
  friend Simd operator-(Simd a, Simd b) { return a.each(std::minus<>{}, b); }
  friend Simd operator*(Simd a, Simd b) { return a.each(std::multiplies<>{}, b); }
  friend Simd operator/(Simd a, Simd b) { return a.each(std::divides<>{}, b); }
  friend Simd operator-(Simd a) { return a.each(std::negate<>{}); }
  friend Simd operator&(Simd a, Simd b) { return a.each(std::bit_and<>{}, b); }
  friend Simd operator~(Simd a) { return a.each(std::bit_not<>{}); }
  friend Int operator<(Simd a, Simd b) { return a.template each<Bits>(std::less<>{}, b); }
  friend Int operator<=(Simd a, Simd b) { return a.template each<Bits>(std::less_equal<>{}, b); }
  friend Int operator>(Simd a, Simd b) { return b < a; }
  Simd& operator+=(Simd b) { return *this = *this + b; }
  Simd& operator-=(Simd b) { return *this = *this - b; }

  /// a where the mask is set, elsewhere b.
  friend Simd choose(Int mask, Simd a, Simd b) {
    return mask.template each<T>([](auto m, Piece x, Piece y) { return m ? x : y; }, a, b);
  }
  /// Where the two are equal / a < b: x, elsewhere +0.
  friend Simd where_equal(Simd a, Simd b, Simd x) {
    return a.each([](Piece p, Piece q, Piece y) { return keep(p == q, y); }, b, x);
  }
  friend Simd where_less(Simd a, Simd b, Simd x) {
    return a.each([](Piece p, Piece q, Piece y) { return keep(p < q, y); }, b, x);
  }

  friend Simd max(Simd a, Simd b) {
    return a.each(
        [](Piece x, Piece y) {
#if defined(__AVX512F__)
          if constexpr (sizeof(T) == 4)
            return std::bit_cast<Piece>(_mm512_max_ps(std::bit_cast<__m512>(x), std::bit_cast<__m512>(y)));
          else
            return std::bit_cast<Piece>(_mm512_max_pd(std::bit_cast<__m512d>(x), std::bit_cast<__m512d>(y)));
#elif defined(__AVX2__)
          if constexpr (sizeof(T) == 4)
            return std::bit_cast<Piece>(_mm256_max_ps(std::bit_cast<__m256>(x), std::bit_cast<__m256>(y)));
          else
            return std::bit_cast<Piece>(_mm256_max_pd(std::bit_cast<__m256d>(x), std::bit_cast<__m256d>(y)));
#else
          return x > y ? x : y;
#endif
        },
        b);
  }
  friend Simd min(Simd a, Simd b) {
    return a.each(
        [](Piece x, Piece y) {
#if defined(__AVX512F__)
          if constexpr (sizeof(T) == 4)
            return std::bit_cast<Piece>(_mm512_min_ps(std::bit_cast<__m512>(x), std::bit_cast<__m512>(y)));
          else
            return std::bit_cast<Piece>(_mm512_min_pd(std::bit_cast<__m512d>(x), std::bit_cast<__m512d>(y)));
#elif defined(__AVX2__)
          if constexpr (sizeof(T) == 4)
            return std::bit_cast<Piece>(_mm256_min_ps(std::bit_cast<__m256>(x), std::bit_cast<__m256>(y)));
          else
            return std::bit_cast<Piece>(_mm256_min_pd(std::bit_cast<__m256d>(x), std::bit_cast<__m256d>(y)));
#else
          return x < y ? x : y;
#endif
        },
        b);
  }
  friend Simd abs(Simd a) {
    constexpr auto sign = std::bit_cast<Bits>(T(-0.0));
    return (a.template bits<Bits>() & ~Int(sign)).template bits<T>();
  }
  friend Simd sqrt(Simd a) {
    return a.each([](Piece x) {
#if defined(__AVX512F__)
      if constexpr (sizeof(T) == 4)
        return std::bit_cast<Piece>(_mm512_sqrt_ps(std::bit_cast<__m512>(x)));
      else
        return std::bit_cast<Piece>(_mm512_sqrt_pd(std::bit_cast<__m512d>(x)));
#elif defined(__AVX2__)
      if constexpr (sizeof(T) == 4)
        return std::bit_cast<Piece>(_mm256_sqrt_ps(std::bit_cast<__m256>(x)));
      else
        return std::bit_cast<Piece>(_mm256_sqrt_pd(std::bit_cast<__m256d>(x)));
#else
      for (int l = 0; l < piece_lanes; ++l) x[l] = std::sqrt(x[l]);
      return x;
#endif
    });
  }

 private:
  /// Not a loop: arrays that loops index stay in memory until g++ has unrolled these, which is late.
  template <class Work>
  [[gnu::always_inline]] static void for_pieces(Work work) {
    [&]<int... k>(std::integer_sequence<int, k...>) { (work(k), ...); }
    (std::make_integer_sequence<int, pieces>{});
  }
  struct from_pieces {};
  template <class... Of>
  [[gnu::always_inline]] Simd(from_pieces, Of... of) : piece{of...} {}
  template <class Mask>
  [[gnu::always_inline]] static Piece keep(Mask mask, Piece x) {
    return std::bit_cast<Piece>(mask & std::bit_cast<Mask>(x));
  }
};

/// Difference b - a of two rows' fixed-point coordinates, stored in the bits of Simd<T>, as a number of
/// units. Modular, hence exact while the true distance is below 2^31 (float) or 2^51 (double) units.
inline Simd<float> coordinate_difference(Simd<float> a, Simd<float> b) {
  const auto d = (b.bits<std::uint32_t>() - a.bits<std::uint32_t>()).bits<std::int32_t>();
  return d.each<float>([](auto x) { return __builtin_convertvector(x, Simd<float>::Piece); });
}
template <int bytes>
Simd<double, bytes> coordinate_difference(Simd<double, bytes> a, Simd<double, bytes> b) {
  using Int = typename Simd<double, bytes>::Int;
  const Int d = b.template bits<std::int64_t>() - a.template bits<std::int64_t>();
#if defined(__AVX512DQ__)
  using Piece = typename Simd<double, bytes>::Piece;
  return d.template each<double>([](auto x) { return __builtin_convertvector(x, Piece); });
#else
  // 1.5 * 2^52: adding |d| < 2^51 to its bits adds d to its value, exactly.
  constexpr double magic = 6755399441055744.0;
  return (d + Int(std::bit_cast<std::int64_t>(magic))).template bits<double>() - magic;
#endif
}

/// Difference b - a of two stored coordinates, stored like them.
inline Simd<float> stored_difference(Simd<float> a, Simd<float> b) {
  return (b.bits<std::uint32_t>() - a.bits<std::uint32_t>()).bits<float>();
}
inline Simd<double> stored_difference(Simd<double> a, Simd<double> b) {
  return (b.bits<std::int64_t>() - a.bits<std::int64_t>()).bits<double>();
}

using Int64x8 = Simd<std::int64_t>;

}  // namespace sph
