// Rows of tables into lanes and back: row index[l] of a table is lane l of as many vectors as a row has values.
#pragma once

#include "sph/core/simd.hpp"

namespace sph {

namespace simd_detail {

#if defined(__AVX512F__) && defined(__AVX512DQ__)

/// Rows 0..3 of this quarter in the low halves and 4..7 in the high ones, transposed 4 x 4 in every 128 bits.
[[gnu::always_inline]] inline void transpose_quarters(__m512 (&r)[4]) {
  const __m512 t0 = _mm512_unpacklo_ps(r[0], r[1]), t1 = _mm512_unpacklo_ps(r[2], r[3]);
  const __m512 t2 = _mm512_unpackhi_ps(r[0], r[1]), t3 = _mm512_unpackhi_ps(r[2], r[3]);
  r[0] = _mm512_shuffle_ps(t0, t1, 0x44);
  r[1] = _mm512_shuffle_ps(t0, t1, 0xee);
  r[2] = _mm512_shuffle_ps(t2, t3, 0x44);
  r[3] = _mm512_shuffle_ps(t2, t3, 0xee);
}

/// Eight values of 16 rows (the rest of a row may be anything): 16 loads of 256 bits and 24 shuffles.
[[gnu::always_inline]] inline void load8(const float* base, std::size_t stride, const std::uint32_t* index,
                                         Simd<float>* out) {
  const auto row = [=](int l) { return base + index[l] * stride; };
  __m512 a[4], b[4];
  for (int k = 0; k < 4; ++k) {
    a[k] = _mm512_castps256_ps512(_mm256_loadu_ps(row(k)));
    a[k] = _mm512_mask_broadcast_f32x8(a[k], 0xff00, _mm256_loadu_ps(row(k + 4)));
    b[k] = _mm512_castps256_ps512(_mm256_loadu_ps(row(k + 8)));
    b[k] = _mm512_mask_broadcast_f32x8(b[k], 0xff00, _mm256_loadu_ps(row(k + 12)));
  }
  transpose_quarters(a);
  transpose_quarters(b);
  for (int k = 0; k < 4; ++k) {
    out[k] = Simd<float>::of(_mm512_shuffle_f32x4(a[k], b[k], 0x88));
    out[k + 4] = Simd<float>::of(_mm512_shuffle_f32x4(a[k], b[k], 0xdd));
  }
}

[[gnu::always_inline]] inline void load4(const float* base, std::size_t stride, const std::uint32_t* index,
                                         Simd<float>* out) {
  const auto row = [=](int l) { return base + index[l] * stride; };
  __m512 r[4];
  for (int k = 0; k < 4; ++k) {
    r[k] = _mm512_castps128_ps512(_mm_loadu_ps(row(k)));
    r[k] = _mm512_mask_broadcast_f32x4(r[k], 0x00f0, _mm_loadu_ps(row(k + 4)));
    r[k] = _mm512_mask_broadcast_f32x4(r[k], 0x0f00, _mm_loadu_ps(row(k + 8)));
    r[k] = _mm512_mask_broadcast_f32x4(r[k], 0xf000, _mm_loadu_ps(row(k + 12)));
  }
  transpose_quarters(r);
  for (int k = 0; k < 4; ++k) out[k] = Simd<float>::of(r[k]);
}

[[gnu::always_inline]] inline void load4(const double* base, std::size_t stride, const std::uint32_t* index,
                                         Simd<double>* out) {
  const auto row = [=](int l) { return base + index[l] * stride; };
  __m512d r[4];
  for (int k = 0; k < 4; ++k) {
    r[k] = _mm512_castpd256_pd512(_mm256_loadu_pd(row(k)));
    r[k] = _mm512_mask_broadcast_f64x4(r[k], 0xf0, _mm256_loadu_pd(row(k + 4)));
  }
  const __m512d t0 = _mm512_unpacklo_pd(r[0], r[1]), t1 = _mm512_unpackhi_pd(r[0], r[1]);
  const __m512d t2 = _mm512_unpacklo_pd(r[2], r[3]), t3 = _mm512_unpackhi_pd(r[2], r[3]);
  const __m512i low = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13),
                high = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
  out[0] = Simd<double>::of(_mm512_permutex2var_pd(t0, low, t2));
  out[1] = Simd<double>::of(_mm512_permutex2var_pd(t1, low, t3));
  out[2] = Simd<double>::of(_mm512_permutex2var_pd(t0, high, t2));
  out[3] = Simd<double>::of(_mm512_permutex2var_pd(t1, high, t3));
}

#elif defined(__AVX2__)

/// Rows k of a 4 x 4 matrix become its columns.
[[gnu::always_inline]] inline void transpose(__m256d (&r)[4]) {
  const __m256d t0 = _mm256_unpacklo_pd(r[0], r[1]), t1 = _mm256_unpackhi_pd(r[0], r[1]);
  const __m256d t2 = _mm256_unpacklo_pd(r[2], r[3]), t3 = _mm256_unpackhi_pd(r[2], r[3]);
  r[0] = _mm256_permute2f128_pd(t0, t2, 0x20);
  r[1] = _mm256_permute2f128_pd(t1, t3, 0x20);
  r[2] = _mm256_permute2f128_pd(t0, t2, 0x31);
  r[3] = _mm256_permute2f128_pd(t1, t3, 0x31);
}

[[gnu::always_inline]] inline void load4(const double* base, std::size_t stride, const std::uint32_t* index,
                                         Simd<double, register_bytes>* out) {
  __m256d r[4];
  for (int k = 0; k < 4; ++k) r[k] = _mm256_loadu_pd(base + index[k] * stride);
  transpose(r);
  for (int k = 0; k < 4; ++k) out[k] = Simd<double, register_bytes>::of(r[k]);
}

[[gnu::always_inline]] inline void load4(const double* base, std::size_t stride, const std::uint32_t* index,
                                         Simd<double>* out) {
  Simd<double, register_bytes> half[2][4];
  for (int h = 0; h < 2; ++h) load4(base, stride, index + 4 * h, half[h]);
  for (int k = 0; k < 4; ++k)
    out[k] = Simd<double>::of(half[0][k].template as<__m256d>(), half[1][k].template as<__m256d>());
}

[[gnu::always_inline]] inline void load4(const float* base, std::size_t stride, const std::uint32_t* index,
                                         Simd<float>* out) {
  __m256 half[2][4];
  for (int h = 0; h < 2; ++h) {
    __m256 r[4];
    for (int k = 0; k < 4; ++k) {
      const __m128 low = _mm_loadu_ps(base + index[8 * h + k] * stride);
      r[k] = _mm256_insertf128_ps(_mm256_castps128_ps256(low),
                                  _mm_loadu_ps(base + index[8 * h + k + 4] * stride), 1);
    }
    const __m256 t0 = _mm256_unpacklo_ps(r[0], r[1]), t1 = _mm256_unpacklo_ps(r[2], r[3]);
    const __m256 t2 = _mm256_unpackhi_ps(r[0], r[1]), t3 = _mm256_unpackhi_ps(r[2], r[3]);
    half[h][0] = _mm256_shuffle_ps(t0, t1, 0x44);
    half[h][1] = _mm256_shuffle_ps(t0, t1, 0xee);
    half[h][2] = _mm256_shuffle_ps(t2, t3, 0x44);
    half[h][3] = _mm256_shuffle_ps(t2, t3, 0xee);
  }
  for (int k = 0; k < 4; ++k) out[k] = Simd<float>::of(half[0][k], half[1][k]);
}

#else

template <class T, int bytes>
[[gnu::always_inline]] inline void load4(const T* base, std::size_t stride, const std::uint32_t* index,
                                         Simd<T, bytes>* out) {
  for (std::size_t k = 0; k < 4; ++k)
    for (int l = 0; l < Simd<T, bytes>::lanes; ++l) out[k].set(l, base[index[l] * stride + k]);
}

#endif

}  // namespace simd_detail

/// Rows index[0 .. lanes) of a table of Stride values a row, transposed: out[k] lane l = row index[l], value
/// k.
template <int Stride, class T, int bytes>
[[gnu::always_inline]] inline void load_rows(const T* base, const std::uint32_t* index, Simd<T, bytes>* out) {
  static_assert(Stride % 4 == 0);
  int k = 0;
#if defined(__AVX512F__) && defined(__AVX512DQ__)
  if constexpr (sizeof(T) == 4)
    for (; k + 8 <= Stride; k += 8) simd_detail::load8(base + k, Stride, index, out + k);
#endif
  for (; k < Stride; k += 4) simd_detail::load4(base + k, Stride, index, out + k);
}

/// The first four values of rows index[0 .. lanes) of a table of Stride values a row, transposed.
template <int Stride, int bytes>
[[gnu::always_inline]] inline void load_vectors(const double* base, const std::uint32_t* index,
                                                Simd<double, bytes> (&out)[4]) {
  simd_detail::load4(base, Stride, index, out);
}

/// Bit l is set where lane l is above zero.
template <int bytes>
[[gnu::always_inline]] inline unsigned positive_lanes(Simd<double, bytes> a) {
#if defined(__AVX512F__)
  return _mm512_cmp_pd_mask(a.template as<__m512d>(), _mm512_setzero_pd(), _CMP_GT_OQ);
#else
  unsigned bits = 0;
#if defined(__AVX2__)
  for (int k = 0; k < a.pieces; ++k) {
    const __m256d above = _mm256_cmp_pd(a.template as<__m256d>(k), _mm256_setzero_pd(), _CMP_GT_OQ);
    bits |= static_cast<unsigned>(_mm256_movemask_pd(above)) << 4 * k;
  }
#else
  for (int l = 0; l < a.lanes; ++l) bits |= (a[l] > 0 ? 1u : 0u) << l;
#endif
  return bits;
#endif
}

/// Nearest integers, ties to even, of |a| < 2^51: as round_to_quanta() for scalars.
template <int bytes>
[[gnu::always_inline]] inline Simd<std::int64_t, bytes> to_integers(Simd<double, bytes> a) {
  return (a + Simd<double, bytes>(rounding_shift)).template bits<std::int64_t>() -
         Simd<std::int64_t, bytes>(std::bit_cast<std::int64_t>(rounding_shift));
}

#if defined(__AVX512F__)
/// Of add_to_rows() for four numbers a row: `rows` has x y of lanes `lane` and `lane` + 4, then z w of both.
template <class T>
[[gnu::always_inline]] inline void add_to_two_rows(T* base, const std::uint32_t* index, int lane,
                                                   __m512i rows) {
  const auto add = [&](std::uint32_t at_row, __m256i row) {
    T* at = base + std::size_t{at_row} * 4;
    if constexpr (std::is_floating_point_v<T>) {
      _mm256_store_pd(at, _mm256_add_pd(_mm256_load_pd(at), _mm256_castsi256_pd(row)));
    } else {
      __m256i* to = reinterpret_cast<__m256i*>(at);
      _mm256_store_si256(to, _mm256_add_epi64(_mm256_load_si256(to), row));
    }
  };
  const __m512i sorted = _mm512_shuffle_i64x2(rows, rows, 0xd8);
  add(index[lane], _mm512_castsi512_si256(sorted));
  add(index[lane + 4], _mm512_extracti64x4_epi64(sorted, 1));
}
#endif

#if defined(__AVX2__) && !defined(__AVX512F__)
/// Of add_to_rows() the lanes of one piece.
template <int Stride, class T, class Lanes>
[[gnu::always_inline]] inline void add_piece_to_rows(T* base, const std::uint32_t* index, int piece,
                                                     const Lanes (&value)[Stride]) {
  __m256d row[Stride / 4][4];
  for (int k = 0; k < Stride; ++k) row[k / 4][k % 4] = value[k].template as<__m256d>(piece);
  for (auto& four : row) simd_detail::transpose(four);
  for (int l = 0; l < 4; ++l)
    for (int q = 0; q < Stride / 4; ++q) {
      T* at = base + std::size_t{index[l]} * Stride + 4 * static_cast<std::size_t>(q);
      if constexpr (std::is_floating_point_v<T>) {
        _mm256_store_pd(at, _mm256_add_pd(_mm256_load_pd(at), row[q][l]));
      } else {
        __m256i* to = reinterpret_cast<__m256i*>(at);
        _mm256_store_si256(to, _mm256_add_epi64(_mm256_load_si256(to), _mm256_castpd_si256(row[q][l])));
      }
    }
}
#endif

/// Adds lane l of value[0 .. Stride) to row index[l] of a table of Stride numbers a row (4 or 8, aligned to
/// its size), lane by lane, so that an index may repeat. T: std::uint64_t, or double (in benchmarks).
template <int Stride, class T, class Lanes>
[[gnu::always_inline]] inline void add_to_rows(T* base, const std::uint32_t* index,
                                               const Lanes (&value)[Stride]) {
  static_assert((Stride == 4 || Stride == 8) && sizeof(T) == 8);
#if defined(__AVX512F__)
  const auto low = [&](int a, int b) {
    return _mm512_unpacklo_epi64(value[a].template as<__m512i>(), value[b].template as<__m512i>());
  };
  const auto high = [&](int a, int b) {
    return _mm512_unpackhi_epi64(value[a].template as<__m512i>(), value[b].template as<__m512i>());
  };
  const __m512i even01 = low(0, 1), odd01 = high(0, 1), even23 = low(2, 3), odd23 = high(2, 3);
  // Blocks of 128 bits: 0x88 takes the first and third of either operand, 0xdd the second and fourth.
  const __m512i a = _mm512_shuffle_i64x2(even01, even23, 0x88),
                c = _mm512_shuffle_i64x2(even01, even23, 0xdd);
  const __m512i b = _mm512_shuffle_i64x2(odd01, odd23, 0x88), d = _mm512_shuffle_i64x2(odd01, odd23, 0xdd);
  if constexpr (Stride == 8) {
    const __m512i even45 = low(4, 5), odd45 = high(4, 5), even67 = low(6, 7), odd67 = high(6, 7);
    const __m512i e = _mm512_shuffle_i64x2(even45, even67, 0x88),
                  g = _mm512_shuffle_i64x2(even45, even67, 0xdd);
    const __m512i f = _mm512_shuffle_i64x2(odd45, odd67, 0x88), h = _mm512_shuffle_i64x2(odd45, odd67, 0xdd);
    const auto add = [&](int lane, __m512i row) {
      T* at = base + std::size_t{index[lane]} * 8;
      if constexpr (std::is_floating_point_v<T>)
        _mm512_store_pd(at, _mm512_add_pd(_mm512_load_pd(at), _mm512_castsi512_pd(row)));
      else
        _mm512_store_si512(at, _mm512_add_epi64(_mm512_load_si512(at), row));
    };
    add(0, _mm512_shuffle_i64x2(a, e, 0x88));
    add(1, _mm512_shuffle_i64x2(b, f, 0x88));
    add(2, _mm512_shuffle_i64x2(c, g, 0x88));
    add(3, _mm512_shuffle_i64x2(d, h, 0x88));
    add(4, _mm512_shuffle_i64x2(a, e, 0xdd));
    add(5, _mm512_shuffle_i64x2(b, f, 0xdd));
    add(6, _mm512_shuffle_i64x2(c, g, 0xdd));
    add(7, _mm512_shuffle_i64x2(d, h, 0xdd));
  } else {
    add_to_two_rows(base, index, 0, a);
    add_to_two_rows(base, index, 1, b);
    add_to_two_rows(base, index, 2, c);
    add_to_two_rows(base, index, 3, d);
  }
#elif defined(__AVX2__)
  for (int k = 0; k < Lanes::pieces; ++k) add_piece_to_rows<Stride>(base, index + 4 * k, k, value);
#else
  for (int l = 0; l < Lanes::lanes; ++l)
    for (int k = 0; k < Stride; ++k)
      base[std::size_t{index[l]} * Stride + static_cast<std::size_t>(k)] += static_cast<T>(value[k][l]);
#endif
}

}  // namespace sph
