// Neighbour lists of one rank: for each owned particle every particle within the list radius, in ascending
// global id. Stored for SIMD: blocks of `lanes` consecutive rows, entry k of lane l at block[k * lanes + l],
// short lists padded with the particle itself. Rows of the four ranges never share a block.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "decomp/grid.hpp"
#include "decomp/memory.hpp"
#include "decomp/timer.hpp"
#include "sph/core/particles.hpp"

namespace sph {

class CellBins;
class ListedByWalls;

/// Consecutive owned rows that a pass can run over, and the first block of their lists.
struct RowRange {
  std::size_t first = 0, last = 0;
  std::size_t first_block = 0;
  [[nodiscard]] std::size_t rows() const { return last - first; }
};

enum class RowClass : std::uint8_t { interior_movers, interior_walls, boundary_movers, boundary_walls };
using RowRanges = std::array<RowRange, 4>;
[[nodiscard]] inline const RowRange& range_of(const RowRanges& ranges, RowClass c) {
  return ranges[static_cast<std::size_t>(c)];
}

/// Free order (lists as they were found) exists to measure what the canonical order costs; benchmarks only.
enum class PartnerOrder { by_id, as_found };

class NeighbourLists {
 public:
  explicit NeighbourLists(int lanes) : lanes_(lanes) {}

  /// Builds the lists of the owned rows, which `ranges` (first, last) tiles; fills in first_block.
  /// `own_cells` is this rank's box; halo rows lie at most one cell outside of it. `radius` in quanta, at
  /// most a cell edge. Where sums of walls are over what moves alone, rows of walls need not list what is of the groups
  /// `unlisted_by_walls`.
  void build(const Particles& particles, const decomp::CellGrid& grid, const decomp::Box& own_cells,
             std::int64_t radius, RowRanges& ranges, decomp::Timers& timers,
             PartnerOrder order = PartnerOrder::by_id, const std::vector<bool>* unlisted_by_walls = nullptr);

  /// Of particles with reaches of their own (in quanta, of every row): j is listed for i if it lies within
  /// the reach of either.
  void build(const Particles& particles, std::span<const double> reach, RowRanges& ranges,
             decomp::Timers& timers);

  /// Those of `all` that bonds can join, or that are of two bodies: whose reference positions (position less displacement)
  /// are within `reach` [quanta], or whose numbers in `body`, by group, differ.
  void build(const Particles& particles, const NeighbourLists& all, const RowRanges& ranges, double reach,
             const std::vector<double>& body);

  /// Those of `all` between what moves and walls, by group.
  void build(const Particles& particles, const NeighbourLists& all, const RowRanges& ranges,
             const std::vector<bool>& is_wall_group);

  [[nodiscard]] int lanes() const { return lanes_; }
  [[nodiscard]] std::size_t blocks() const { return begin_.size() - 1; }
  [[nodiscard]] std::span<const std::uint32_t> block(std::size_t b) const {
    return {entries_.data() + begin_[b], entries_.data() + begin_[b + 1]};
  }
  [[nodiscard]] std::size_t pairs() const { return pairs_; }  ///< directed pairs listed, padding not counted

 private:
  template <int D>
  void find(const CellBins&, const std::vector<std::uint32_t>& tags, const ListedByWalls*, RowRanges&);
  template <int D>
  void find(const Particles&, std::span<const double> reach, const std::vector<std::uint32_t>& tag_of_row,
            RowRanges&);
  template <class Possible, class Wanted>
  void keep(const NeighbourLists& all, const RowRanges&, Possible possible, Wanted wanted);
  void finish(const std::vector<std::uint32_t>& row_of_tag, const RowRanges&, bool sort);

  int lanes_;
  std::vector<std::uint64_t> begin_{0};  ///< entries before each block, then their number
  decomp::LargeVector<std::uint32_t> entries_;
  std::size_t pairs_ = 0;
};

}  // namespace sph
