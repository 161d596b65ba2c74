#include "sph/pairs/neighbour_lists.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

#include "pairs/candidates.hpp"
#include "pairs/id_rank.hpp"
#include "pairs/lane_sort.hpp"
#include "sph/core/simd_rows.hpp"

namespace sph {
namespace {

constexpr std::uint32_t no_partner = ~std::uint32_t{0};
constexpr std::size_t chunk = CandidateTable::chunk;

/// Turns `lanes` lists of `longest` entries, stored one after the other `stride` apart, into the SIMD order.
void transpose_lists(const std::uint32_t* lists, std::size_t stride, std::size_t lanes, std::size_t longest,
                     std::uint32_t* out) {
  std::uint32_t index[chunk];
  for (std::size_t l = 0; l < chunk; ++l) index[l] = static_cast<std::uint32_t>(l % lanes);
  for (std::size_t k = 0; k < longest; k += 4) {
    Simd<float> column[4];
    simd_detail::load4(reinterpret_cast<const float*>(lists) + k, stride, index, column);
    for (std::size_t c = 0; c < 4 && k + c < longest; ++c)
      std::memcpy(out + (k + c) * lanes, &column[c], lanes * 4);
  }
}

/// For `more` entries, of a row after `done` of `rows`. Lists that grew by doubling would be there three times for a while.
void make_room(decomp::LargeVector<std::uint32_t>& entries, std::size_t more, std::size_t done,
               std::size_t rows) {
  constexpr std::size_t some = 4096;  // rows that tell how long lists are
  const std::size_t size = entries.size() + more;
  if (size <= entries.capacity() || done < some) return;
  entries.reserve(size + size / done * (rows - done) + size / 8);
}

}  // namespace

/// What rows of walls list where that is not all: the rest has no tag.
class ListedByWalls {
 public:
  ListedByWalls(const Particles& particles, const CellBins& bins, const std::vector<bool>& unlisted,
                const std::vector<std::uint32_t>& all_tags)
      : tags(all_tags), before_(particles.rows() + 1, 0) {
    const auto* group = particles.data<Field::group>();
    for (std::size_t k = 0; k < particles.rows(); ++k) {
      const bool listed = !unlisted[group[bins.rows()[k]]];
      if (!listed) tags[k] = no_partner;
      before_[k + 1] = before_[k] + (listed ? 1 : 0);
    }
  }
  /// Leaves out the runs in which nothing has a tag: most of a wall that nothing touches.
  [[nodiscard]] std::span<const CellBins::Run> of(std::span<const CellBins::Run> runs,
                                                  CellBins::Runs& out) const {
    std::size_t n = 0;
    for (const CellBins::Run run : runs)
      if (before_[run.last] > before_[run.first]) out[n++] = run;
    return {out, n};
  }

  std::vector<std::uint32_t> tags;

 private:
  std::vector<std::uint32_t> before_;
};

// Entries are tags (ranks by id, or rows) until finish() turns them into rows; short lists end in no_partner.
template <int D>
void NeighbourLists::find(const CellBins& bins, const std::vector<std::uint32_t>& all_tags,
                          const ListedByWalls* by_walls, RowRanges& ranges) {
  const std::size_t lanes = static_cast<std::size_t>(lanes_);
  begin_.assign(1, 0);
  entries_.clear();
  pairs_ = 0;
  std::size_t stride = 0;
  std::vector<std::uint32_t> lists;
  for (RowRange& range : ranges) {
    range.first_block = begin_.size() - 1;
    const bool walls = &range == &ranges[static_cast<std::size_t>(RowClass::interior_walls)] ||
                       &range == &ranges[static_cast<std::size_t>(RowClass::boundary_walls)];
    const ListedByWalls* const some = walls ? by_walls : nullptr;
    const std::vector<std::uint32_t>& tags = some != nullptr ? some->tags : all_tags;
    const CandidateTable candidates{bins, tags.data()};
    std::uint32_t cell = no_partner;
    CellBins::Runs all_runs;
    std::span<const CellBins::Run> runs;
    for (std::size_t first = range.first; first < range.last; first += lanes) {
      std::size_t longest = 0, length[chunk] = {};
      for (std::size_t l = 0; l < std::min(lanes, range.last - first); ++l) {
        const std::size_t place = bins.place(first + l);
        if (bins.bin(first + l) != cell) {
          cell = bins.bin(first + l);
          runs = bins.runs(cell, all_runs);
          if (some != nullptr) runs = some->of(runs, all_runs);
          if (const std::size_t room = CandidateTable::room(runs) + chunk; room > stride) {
            std::vector<std::uint32_t> wider(lanes * 2 * room);
            for (std::size_t k = 0; k < l; ++k)
              std::copy_n(lists.data() + k * stride, length[k], wider.data() + k * 2 * room);
            lists.swap(wider);
            stride = 2 * room;
          }
        }
        const float at[3] = {bins.x(0)[place], bins.x(1)[place], D == 3 ? bins.x(2)[place] : 0};
        const std::size_t n =
            candidates.find<D, Keep::others>(runs, at, bins.limit(), tags[place], lists.data() + l * stride);
        length[l] = n;
        pairs_ += n;
        longest = std::max(longest, n);
      }
      for (std::size_t l = 0; l < lanes; ++l)
        std::fill(lists.begin() + static_cast<std::ptrdiff_t>(l * stride + length[l]),
                  lists.begin() + static_cast<std::ptrdiff_t>(l * stride + (longest + 7) / 8 * 8),
                  no_partner);
      const std::size_t start = entries_.size();
      make_room(entries_, longest * lanes, first, ranges.back().last);
      entries_.resize(start + longest * lanes);
      transpose_lists(lists.data(), stride, lanes, longest, entries_.data() + start);
      begin_.push_back(entries_.size());
    }
  }
}

void NeighbourLists::finish(const std::vector<std::uint32_t>& row_of_tag, const RowRanges& ranges,
                            bool sort) {
  const std::size_t lanes = static_cast<std::size_t>(lanes_);
  for (const RowRange& range : ranges)
    for (std::size_t first = range.first, b = range.first_block; first < range.last; first += lanes, ++b) {
      std::uint32_t* entries = entries_.data() + begin_[b];
      const std::size_t longest = (begin_[b + 1] - begin_[b]) / lanes;
      if (sort) lanes_ == 16 ? sort_lanes<16>(entries, longest) : sort_lanes<8>(entries, longest);
      for (std::size_t l = 0; l < lanes; ++l) {
        const std::uint32_t self = static_cast<std::uint32_t>(std::min(first + l, range.last - 1));
        for (std::size_t k = l; k < longest * lanes; k += lanes)
          entries[k] = entries[k] == no_partner ? self : row_of_tag[entries[k]];
      }
    }
}

void NeighbourLists::build(const Particles& particles, const decomp::CellGrid& grid,
                           const decomp::Box& own_cells, std::int64_t radius, RowRanges& ranges,
                           decomp::Timers& timers, PartnerOrder order,
                           const std::vector<bool>* unlisted_by_walls) {
  const bool by_id = order == PartnerOrder::by_id;
  std::vector<std::uint32_t> row_of_tag, tag_of_row;
  {
    const auto timing = timers.time(decomp::Region::order);
    if (by_id) {
      IdRank ids(particles.data<Field::id>(), particles.rows());
      row_of_tag = std::move(ids.row_of_rank);
      tag_of_row = std::move(ids.rank_of_row);
    } else {
      row_of_tag.resize(particles.rows());
      std::iota(row_of_tag.begin(), row_of_tag.end(), 0u);
      tag_of_row = row_of_tag;
    }
  }
  {
    const auto timing = timers.time(decomp::Region::lists);
    const CellBins bins(particles, grid, own_cells, radius);
    std::vector<std::uint32_t> tags(bins.rows().size(), no_partner);
    for (std::size_t k = 0; k < particles.rows(); ++k) tags[k] = tag_of_row[bins.rows()[k]];
    std::optional<ListedByWalls> by_walls;
    if (unlisted_by_walls != nullptr) by_walls.emplace(particles, bins, *unlisted_by_walls, tags);
    const ListedByWalls* const some = by_walls ? &*by_walls : nullptr;
    particles.dim() == 2 ? find<2>(bins, tags, some, ranges) : find<3>(bins, tags, some, ranges);
  }
  const auto timing = timers.time(by_id ? decomp::Region::order : decomp::Region::lists);
  finish(row_of_tag, ranges, by_id);
}

}  // namespace sph
