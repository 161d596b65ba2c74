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
      Simd<float> x;
      std::memcpy(&x.v, bins.x(a) + first, sizeof x.v);
      x -= Simd<float>(at[a]);
      d2 += x * x;
    }
    if (reach != nullptr) {
      std::memcpy(&limit.v, reach + first, sizeof limit.v);
      limit += Simd<float>(own_reach);
    }
    limit = limit * limit;
    const unsigned inside = last - first >= chunk ? 0xffffu : (1u << (last - first)) - 1;
#if defined(__AVX512F__)
    const __m512i tag = _mm512_loadu_si512(tags + first), mine = _mm512_set1_epi32(static_cast<int>(own));
    __mmask16 mask =
        _mm512_cmp_ps_mask(std::bit_cast<__m512>(d2.v), std::bit_cast<__m512>(limit.v), _CMP_LT_OQ);
    mask = static_cast<__mmask16>(mask & inside);
    if constexpr (keep == Keep::others) mask = _mm512_mask_cmpneq_epi32_mask(mask, tag, mine);
    if constexpr (keep == Keep::above) mask = _mm512_mask_cmpgt_epu32_mask(mask, tag, mine);
    _mm512_storeu_si512(out, _mm512_maskz_compress_epi32(mask, tag));
    return static_cast<std::size_t>(std::popcount(static_cast<unsigned>(mask)));
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
