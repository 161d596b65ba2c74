#include "sph/contact_lists.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "pairs/cell_bins.hpp"
#include "sph/simd.hpp"

namespace sph {
namespace {

constexpr std::size_t lanes = ContactGroups::lanes;
constexpr std::size_t chunk = Simd<float>::lanes;

/// Rows by bin with what the filter needs of them, in the order of the bins.
struct Candidates {
  const CellBins& bins;
  std::vector<float> reach;            ///< r + skin / 2 + slack, in units of the bins
  std::vector<std::uint32_t> partner;  ///< row

  Candidates(const Particles& p, const CellBins& b, double skin, double unit) : bins(b) {
    const std::size_t rows = p.rows();
    reach.assign(rows + CellBins::padding, 0.0f);
    partner.assign(rows + CellBins::padding, 0u);
    const double* radius = p.data<Field::radius>();
    // The bins' limit is 1 and the rounding of positions to float: half of that for each partner.
    const float slack = 0.5f * (bins.limit() - 1.0f);
    for (std::size_t k = 0; k < rows; ++k) {
      partner[k] = bins.rows()[k];
      reach[k] = static_cast<float>((radius[partner[k]] + 0.5 * skin) / unit) + slack;
    }
  }

  /// Appends to `out` those of the 16 rows from bin `first` on, rows above `own` only, that lie within reach
  /// of the row at bin `place`; writes up to 16 beyond the end. Returns how many were appended.
  std::size_t append(std::size_t first, std::size_t last, std::size_t place, std::uint32_t own,
                     std::uint32_t* out) const {
    Simd<float> d2 = Simd<float>::zero(), limit;
    for (int a = 0; a < 3; ++a) {
      Simd<float> x;
      std::memcpy(&x.v, bins.x(a) + first, sizeof x.v);
      x -= Simd<float>(bins.x(a)[place]);
      d2 += x * x;
    }
    std::memcpy(&limit.v, reach.data() + first, sizeof limit.v);
    limit += Simd<float>(reach[place]);
    limit = limit * limit;
    const unsigned inside = last - first >= chunk ? 0xffffu : (1u << (last - first)) - 1;
#if defined(__AVX512F__)
    const __m512i row = _mm512_loadu_si512(partner.data() + first);
    __mmask16 mask =
        _mm512_cmp_ps_mask(std::bit_cast<__m512>(d2.v), std::bit_cast<__m512>(limit.v), _CMP_LT_OQ);
    mask = static_cast<__mmask16>(mask & inside);
    mask = _mm512_mask_cmpgt_epu32_mask(mask, row, _mm512_set1_epi32(static_cast<int>(own)));
    _mm512_storeu_si512(out, _mm512_maskz_compress_epi32(mask, row));
    return static_cast<std::size_t>(std::popcount(static_cast<unsigned>(mask)));
#else
    std::size_t n = 0;
    for (std::size_t l = 0; l < chunk; ++l) {
      out[n] = partner[first + l];
      n += (inside >> l & 1u) != 0 && d2[static_cast<int>(l)] < limit[static_cast<int>(l)] &&
           partner[first + l] > own;
    }
    return n;
#endif
  }
};

/// Appends to groups of contacts whose old entries are overwritten, not cleared.
class Writer {
 public:
  explicit Writer(ContactGroups& g) : g_(g) {}
  [[nodiscard]] std::size_t groups() const { return n_ / lanes; }
  /// Where the next `room` partners may be written before add() says how many of them were.
  [[nodiscard]] std::uint32_t* partners(std::size_t room) {
    if (g_.j.size() < n_ + room) {
      const std::size_t size = std::max(n_ + room, g_.j.size() + g_.j.size() / 2);
      g_.i.resize(size);
      g_.j.resize(size);
    }
    return g_.j.data() + n_;
  }
  void add(std::uint32_t i, std::size_t count) {
    std::fill_n(g_.i.data() + n_, count, i);
    n_ += count;
  }
  /// Fills the last group with pairs (i, j) that are none.
  void pad(std::uint32_t i, std::uint32_t j) {
    const std::size_t rest = (lanes - n_ % lanes) % lanes;
    std::fill_n(partners(rest), rest, j);
    add(i, rest);
  }
  void finish(std::size_t history) {
    g_.i.resize(n_);
    g_.j.resize(n_);
    g_.touching.assign(groups(), 0);
    g_.history.assign(n_ * history, 0.0);
  }

 private:
  ContactGroups& g_;
  std::size_t n_ = 0;
};

}  // namespace

void ContactLists::build(const Particles& p, const decomp::CellGrid& grid, const decomp::Box& own_cells,
                         std::int64_t reach, double skin, double quantum, const RowRanges& ranges,
                         const std::vector<bool>& fixed, std::span<const PlaneNow> planes) {
  const CellBins bins(p, grid, own_cells, reach);
  const Candidates candidates(p, bins, skin, static_cast<double>(reach) * quantum);
  const auto* group = p.data<Field::group>();
  const auto* x = p.data<Field::position>();
  const double* radius = p.data<Field::radius>();
  blocks_.clear();
  Writer pairs(pairs_), walls(walls_);
  listed_ = 0;
  std::uint32_t cell = ~std::uint32_t{0};
  CellBins::Runs runs;
  int n_runs = 0;
  std::size_t room = 0;  ///< for all candidates of the cell
  for (const RowRange& range : ranges) {
    if (&range == &ranges[static_cast<std::size_t>(RowClass::boundary_movers)])
      interior_blocks_ = blocks_.size();
    for (std::size_t first = range.first; first < range.last; first += ContactBlock::rows) {
      ContactBlock block{static_cast<std::uint32_t>(first),
                         static_cast<std::uint32_t>(std::min(first + ContactBlock::rows, range.last)),
                         pairs.groups(),
                         0,
                         walls.groups(),
                         0};
      for (std::uint32_t row = block.first; row < block.last; ++row) {
        const bool is_fixed = fixed[group[row]];
        if (bins.bin(row) != cell) {
          n_runs = bins.runs(cell = bins.bin(row), runs);
          room = chunk;
          for (int r = 0; r < n_runs; ++r) room += runs[r].last - runs[r].first;
        }
        std::uint32_t* const partner = pairs.partners(room);
        std::size_t n = 0;
        for (int r = 0; r < n_runs; ++r)
          for (std::size_t k = runs[r].first; k < runs[r].last; k += chunk)
            n += candidates.append(k, runs[r].last, bins.place(row), row, partner + n);
        if (is_fixed)
          n = static_cast<std::size_t>(
              std::remove_if(partner, partner + n, [&](std::uint32_t j) { return fixed[group[j]]; }) -
              partner);
        pairs.add(row, n);
        listed_ += n;
        for (std::uint32_t w = 0; w < planes.size() && !is_fixed; ++w)
          if (planes[w].present && distance_from(planes[w], x + row * 3, quantum) < radius[row] + skin) {
            *walls.partners(1) = w;
            walls.add(row, 1);
          }
      }
      pairs.pad(block.first, block.first);
      walls.pad(block.first, ContactGroups::no_wall);
      block.pairs_end = pairs.groups();
      block.walls_end = walls.groups();
      blocks_.push_back(block);
    }
  }
  pairs.finish(history_);
  walls.finish(history_);
}

std::size_t ContactLists::bytes() const {
  std::size_t sum = blocks_.capacity() * sizeof(ContactBlock);
  for (const ContactGroups* g : {&pairs_, &walls_})
    sum += (g->i.capacity() + g->j.capacity()) * 4 + g->touching.capacity() + g->history.capacity() * 8;
  return sum;
}

}  // namespace sph
