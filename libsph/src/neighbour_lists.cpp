#include "sph/neighbour_lists.hpp"

#include <algorithm>
#include <bit>

#include "id_rank.hpp"
#include "lane_sort.hpp"
#include "sph/simd.hpp"

namespace sph {
namespace {

constexpr std::uint32_t no_partner = ~std::uint32_t{0};

/// The rank's own box of cells and one layer around it, with all rows binned (counting sort).
class Bins {
 public:
  Bins(const Particles& particles, const decomp::CellGrid& grid, const decomp::Box& own)
      : grid_(grid), dim_(particles.dim()) {
    for (int a = 0; a < 3; ++a) {
      lo_[a] = a < dim_ ? own.lo[a] - 1 : 0;
      extent_[a] = a < dim_ ? own.hi[a] - own.lo[a] + 2 : 1;
    }
    const std::size_t cells = static_cast<std::size_t>(extent_[0] * extent_[1] * extent_[2]);
    const std::size_t rows = particles.rows();
    const std::int64_t* x = particles.data<Field::position>();
    cell_.resize(rows);
    start_.assign(cells + 1, 0);
    for (std::size_t i = 0; i < rows; ++i) {
      cell_[i] = static_cast<std::uint32_t>(index(x + i * static_cast<std::size_t>(dim_)));
      ++start_[cell_[i] + 1];
    }
    for (std::size_t c = 0; c < cells; ++c) start_[c + 1] += start_[c];
    rows_.resize(rows);
    std::vector<std::uint32_t> at(start_.begin(), start_.end() - 1);
    for (std::size_t i = 0; i < rows; ++i) rows_[at[cell_[i]]++] = static_cast<std::uint32_t>(i);
  }

  [[nodiscard]] std::uint32_t cell(std::size_t row) const { return cell_[row]; }

  /// Calls visit(row) for every row in the cell and its neighbours.
  template <class Visit>
  void around(std::uint32_t cell, Visit visit) const {
    const std::int64_t z = cell / (extent_[0] * extent_[1]);
    const std::int64_t y = cell / extent_[0] % extent_[1];
    const std::int64_t x = cell % extent_[0];
    for (std::int64_t k = std::max<std::int64_t>(z - 1, 0); k <= std::min(z + 1, extent_[2] - 1); ++k)
      for (std::int64_t j = std::max<std::int64_t>(y - 1, 0); j <= std::min(y + 1, extent_[1] - 1); ++j) {
        const std::int64_t line = (k * extent_[1] + j) * extent_[0];
        const std::uint32_t first = start_[static_cast<std::size_t>(line + std::max<std::int64_t>(x - 1, 0))];
        const std::uint32_t last =
            start_[static_cast<std::size_t>(line + std::min(x + 1, extent_[0] - 1)) + 1];
        for (std::uint32_t r = first; r < last; ++r) visit(rows_[r]);
      }
  }

 private:
  /// Halo copies of a periodic image lie outside the domain: they go to the layer just outside the box.
  [[nodiscard]] std::int64_t index(const std::int64_t* x) const {
    std::int64_t at = 0, stride = 1;
    for (int a = 0; a < dim_; ++a) {
      const std::int64_t t = x[a] - grid_.origin()[a];
      std::int64_t c = t < 0                    ? -1
                       : t >= grid_.length()[a] ? grid_.cells()[a]
                                                : std::min(t / grid_.edge()[a], grid_.cells()[a] - 1);
      if (!grid_.periodic()[static_cast<std::size_t>(a)])
        c = std::clamp<std::int64_t>(c, 0, grid_.cells()[a] - 1);
      at += std::clamp<std::int64_t>(c - lo_[a], 0, extent_[a] - 1) * stride;
      stride *= extent_[a];
    }
    return at;
  }

  const decomp::CellGrid& grid_;
  int dim_;
  decomp::Int3 lo_{}, extent_{1, 1, 1};
  std::vector<std::uint32_t> cell_, start_, rows_;
};

/// Candidates of one cell with float positions relative to one of its own particles, padded far away.
struct Candidates {
  static constexpr int lanes = Simd<float>::lanes;
  std::vector<std::uint32_t> row;
  std::vector<float> x[3];
  std::size_t count = 0;

  void add(std::uint32_t r, const std::int64_t* position, const std::int64_t* origin, int dim, float unit) {
    if (count + lanes >= row.size()) {
      row.resize(2 * row.size() + 256);
      for (auto& v : x) v.resize(row.size());
    }
    row[count] = r;
    for (int a = 0; a < dim; ++a) x[a][count] = static_cast<float>(position[a] - origin[a]) * unit;
    ++count;
  }
  void pad(int dim) {
    for (int l = 0; l < lanes; ++l)
      for (int a = 0; a < dim; ++a) x[a][count + static_cast<std::size_t>(l)] = 1e9f;
  }
};

/// Bit l of the result: |candidate l - at|^2 < limit.
template <int D>
[[nodiscard]] unsigned within(const Candidates& c, std::size_t first, const float* at, float limit) {
  Simd<float> d2 = Simd<float>::zero();
  for (int a = 0; a < D; ++a) {
    Simd<float> x;
    std::memcpy(&x.v, c.x[a].data() + first, sizeof x.v);
    x -= Simd<float>(at[a]);
    d2 += x * x;
  }
#if defined(__AVX512F__)
  return _mm512_cmp_ps_mask(std::bit_cast<__m512>(d2.v), _mm512_set1_ps(limit), _CMP_LT_OQ);
#else
  unsigned mask = 0;
  for (int l = 0; l < Candidates::lanes; ++l) mask |= static_cast<unsigned>(d2[l] < limit) << l;
  return mask;
#endif
}

}  // namespace

void NeighbourLists::find(const Particles& particles, const decomp::CellGrid& grid,
                          const decomp::Box& own_cells, std::int64_t radius, RowRanges& ranges) {
  const Bins bins(particles, grid, own_cells);
  const int dim = particles.dim();
  const std::int64_t* x = particles.data<Field::position>();
  // Distances in units of the radius. The margin covers the rounding to float: a list may hold more than it
  // must, since a partner beyond the support adds exactly nothing.
  const float unit = 1.0f / static_cast<float>(radius);
  const float limit = 1.0f + 1e-5f;
  const std::size_t lanes = static_cast<std::size_t>(lanes_);

  begin_.assign(1, 0);
  entries_.clear();
  pairs_ = 0;
  Candidates candidates;
  std::vector<std::vector<std::uint32_t>> list(lanes);
  for (RowRange& range : ranges) {
    range.first_block = begin_.size() - 1;
    std::uint32_t cell = no_partner;
    const std::int64_t* origin = nullptr;
    for (std::size_t first = range.first; first < range.last; first += lanes) {
      const std::size_t count = std::min(lanes, range.last - first);
      std::size_t longest = 0;
      for (std::size_t l = 0; l < count; ++l) {
        const std::size_t i = first + l;
        const std::int64_t* xi = x + i * static_cast<std::size_t>(dim);
        if (bins.cell(i) != cell) {
          cell = bins.cell(i);
          origin = xi;
          candidates.count = 0;
          bins.around(cell, [&](std::uint32_t r) {
            candidates.add(r, x + static_cast<std::size_t>(r) * static_cast<std::size_t>(dim), origin, dim,
                           unit);
          });
          candidates.pad(dim);
        }
        float at[3];
        for (int a = 0; a < dim; ++a) at[a] = static_cast<float>(xi[a] - origin[a]) * unit;
        std::vector<std::uint32_t>& mine = list[l];
        mine.resize(candidates.count + 1);
        std::size_t n = 0;
        for (std::size_t c = 0; c < candidates.count; c += Candidates::lanes) {
          unsigned mask =
              dim == 2 ? within<2>(candidates, c, at, limit) : within<3>(candidates, c, at, limit);
          for (; mask != 0; mask &= mask - 1) {
            mine[n] = candidates.row[c + static_cast<std::size_t>(std::countr_zero(mask))];
            n += mine[n] != i;
          }
        }
        mine.resize(n);
        pairs_ += n;
        longest = std::max(longest, n);
      }
      const std::size_t start = entries_.size();
      entries_.resize(start + longest * lanes, no_partner);
      for (std::size_t l = 0; l < count; ++l)
        for (std::size_t k = 0; k < list[l].size(); ++k) entries_[start + k * lanes + l] = list[l][k];
      begin_.push_back(entries_.size());
    }
  }
}

void NeighbourLists::sort_by_id(const Particles& particles, const RowRanges& ranges) {
  const IdRank ids(particles.data<Field::id>(), particles.rows());
  for (const RowRange& range : ranges)
    for (std::size_t first = range.first, b = range.first_block; first < range.last;
         first += static_cast<std::size_t>(lanes_), ++b) {
      std::uint32_t* entries = entries_.data() + begin_[b];
      const std::size_t count = begin_[b + 1] - begin_[b];
      for (std::size_t k = 0; k < count; ++k)
        if (entries[k] != no_partner) entries[k] = ids.rank_of_row(entries[k]);
      if (lanes_ == 16)
        sort_lanes<16>(entries, count / 16);
      else
        sort_lanes<8>(entries, count / 8);
      for (std::size_t k = 0; k < count; ++k)
        if (entries[k] != no_partner) entries[k] = ids.row_of_rank(entries[k]);
    }
}

void NeighbourLists::build(const Particles& particles, const decomp::CellGrid& grid,
                           const decomp::Box& own_cells, std::int64_t radius, RowRanges& ranges,
                           decomp::Timers& timers, PartnerOrder order) {
  {
    const auto timing = timers.time(decomp::Region::lists);
    find(particles, grid, own_cells, radius, ranges);
  }
  if (order == PartnerOrder::by_id) {
    const auto timing = timers.time(decomp::Region::order);
    sort_by_id(particles, ranges);
  }
  const auto timing = timers.time(decomp::Region::lists);
  for (const RowRange& range : ranges)
    for (std::size_t first = range.first, b = range.first_block; first < range.last;
         first += static_cast<std::size_t>(lanes_), ++b)
      for (std::size_t k = begin_[b]; k < begin_[b + 1]; ++k)
        if (entries_[k] == no_partner)
          entries_[k] = static_cast<std::uint32_t>(
              std::min(first + (k - begin_[b]) % static_cast<std::size_t>(lanes_), range.last - 1));
}

}  // namespace sph
