// The one search for neighbours: candidates of a particle are runs of rows in the order of their cells
// (cell_bins.hpp), filtered sixteen at a time by their distance. Which of two rows of a pair lists it, and
// whether each candidate has a reach of its own, is said by the caller.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>

#include "pairs/cell_bins.hpp"
#include "sph/core/simd.hpp"

namespace sph {

/// Which candidates are kept besides those that are too far.
enum class Keep { all, others, above };  ///< any, all with another tag than the row's own, those above it

#if defined(__AVX2__) && !defined(__AVX512F__)
/// Of each mask of eight lanes those that are set, ascending, a byte each.
inline constexpr std::array<std::uint64_t, 256> set_lanes = [] {
  std::array<std::uint64_t, 256> of{};
  for (unsigned mask = 0; mask < 256; ++mask)
    for (unsigned lane = 8; lane-- > 0;)
      if ((mask >> lane & 1u) != 0) of[mask] = of[mask] << 8 | lane;
  return of;
}();
#endif

/// Tags (rows, or ranks by id) and reaches of candidates in the order of the bins, padded as the bins are.
struct CandidateTable {
  const CellBins& bins;
  const std::uint32_t* tags;
  const float* reach =
      nullptr;  ///< of each; a pair is listed within the sum of both. Else all have one reach.

  static constexpr std::size_t chunk = Simd<float>::lanes;

  /// Appends to `out` the tags of candidates in the bins' runs around `bin` that lie within reach of `at`,
  /// which itself has the reach `own_reach` and the tag `own`; writes up to `chunk` beyond the end. Returns
  /// how many were appended.
  template <int D, Keep keep>
  std::size_t find(std::span<const CellBins::Run> runs, const float* at, float own_reach, std::uint32_t own,
                   std::uint32_t* out) const {
    std::size_t n = 0;
    for (const CellBins::Run& run : runs)
      for (std::size_t k = run.first; k < run.last; k += chunk)
        n += append<D, keep>(k, run.last, at, own_reach, own, out + n);
    return n;
  }
  /// Room that find() needs for a row with these runs.
  [[nodiscard]] static std::size_t room(std::span<const CellBins::Run> runs) {
    std::size_t n = chunk;
    for (const CellBins::Run& run : runs) n += run.last - run.first;
    return n;
  }

 private:
  template <int D, Keep keep>
  [[gnu::always_inline]] std::size_t append(std::size_t first, std::size_t last, const float* at,
                                            float own_reach, std::uint32_t own, std::uint32_t* out) const {
    Simd<float> d2 = Simd<float>::zero(), limit(own_reach);
    for (int a = 0; a < D; ++a) {
      const Simd<float> x = Simd<float>::load(bins.x(a) + first) - Simd<float>(at[a]);
      d2 += x * x;
    }
    if (reach != nullptr) limit += Simd<float>::load(reach + first);
    limit = limit * limit;
    const unsigned inside = last - first >= chunk ? 0xffffu : (1u << (last - first)) - 1;
#if defined(__AVX512F__)
    const __m512i tag = _mm512_loadu_si512(tags + first), mine = _mm512_set1_epi32(static_cast<int>(own));
    __mmask16 mask = _mm512_cmp_ps_mask(d2.as<__m512>(), limit.as<__m512>(), _CMP_LT_OQ);
    mask = static_cast<__mmask16>(mask & inside);
    if constexpr (keep == Keep::others) mask = _mm512_mask_cmpneq_epi32_mask(mask, tag, mine);
    if constexpr (keep == Keep::above) mask = _mm512_mask_cmpgt_epu32_mask(mask, tag, mine);
    _mm512_storeu_si512(out, _mm512_maskz_compress_epi32(mask, tag));
    return static_cast<std::size_t>(std::popcount(static_cast<unsigned>(mask)));
#elif defined(__AVX2__)
    const auto append_half = [&](std::size_t half, std::uint32_t* to) {
      const __m256i tag = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(tags + first + half * 8));
      const __m256i mine = _mm256_set1_epi32(static_cast<int>(own));
      __m256i unwanted = _mm256_setzero_si256();
      if constexpr (keep == Keep::others) unwanted = _mm256_cmpeq_epi32(tag, mine);
      if constexpr (keep == Keep::above) unwanted = _mm256_cmpeq_epi32(_mm256_min_epu32(tag, mine), tag);
      const int h = static_cast<int>(half);
      const __m256 near = _mm256_cmp_ps(d2.as<__m256>(h), limit.as<__m256>(h), _CMP_LT_OQ);
      const auto bits =
          static_cast<unsigned>(_mm256_movemask_ps(_mm256_andnot_ps(_mm256_castsi256_ps(unwanted), near)));
      const unsigned mask = bits & inside >> 8 * half & 0xffu;
      const __m256i kept = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(static_cast<long long>(set_lanes[mask])));
      _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm256_permutevar8x32_epi32(tag, kept));
      return static_cast<std::size_t>(std::popcount(mask));
    };
    const std::size_t n = append_half(0, out);
    return last - first > 8 ? n + append_half(1, out + n) : n;
#else
    std::size_t n = 0;
    for (std::size_t l = 0; l < chunk; ++l) {
      const std::uint32_t tag = tags[first + l];
      const bool wanted = keep == Keep::all || (keep == Keep::others ? tag != own : tag > own);
      out[n] = tag;
      n += (inside >> l & 1u) != 0 && d2[static_cast<int>(l)] < limit[static_cast<int>(l)] && wanted;
    }
    return n;
#endif
  }
};

}  // namespace sph
