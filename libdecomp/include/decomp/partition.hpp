// Jagged rectangular partition (Furuichi & Nishiura 2017; seed 003 figure 3): one axis is cut into P rows,
// row r into its own Q_r columns along the other axis; sum Q_r = ranks. Cuts lie on cell lines. Every rank
// holds all cuts (8 bytes each), so owners and peers are found without communication.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "decomp/grid.hpp"
#include "decomp/types.hpp"

namespace decomp {

/// Cut positions in cells. row has P+1 entries from 0 to cells(row_axis); column[r] has Q_r+1 entries.
struct Cuts {
  std::vector<std::int64_t> row;
  std::vector<std::vector<std::int64_t>> column;
  friend bool operator==(const Cuts&, const Cuts&) = default;
};

[[nodiscard]] std::size_t part_count(const Cuts& cuts);

class JaggedPartition {
 public:
  /// Throws InputError if the cuts are not strictly increasing from 0 to the grid's end, or a part is
  /// thinner than min_width cells.
  JaggedPartition(const CellGrid& grid, int row_axis, int column_axis, Cuts cuts);

  static constexpr std::int64_t min_width = 1;  ///< cells; the halo is one cell deep

  [[nodiscard]] int ranks() const { return static_cast<int>(first_.back()); }
  [[nodiscard]] int rows() const { return static_cast<int>(cuts_.row.size()) - 1; }
  [[nodiscard]] const CellGrid& grid() const { return grid_; }
  [[nodiscard]] const Cuts& cuts() const { return cuts_; }
  [[nodiscard]] int row_axis() const { return row_axis_; }
  [[nodiscard]] int column_axis() const { return column_axis_; }
  [[nodiscard]] Rank owner(const Int3& cell) const;
  [[nodiscard]] Box cells(Rank r) const;   ///< [cells], half-open
  [[nodiscard]] Box quanta(Rank r) const;  ///< the same box in quanta; outer faces of a non-periodic axis
                                           ///< reach to +-2^62, since such positions belong to the edge cells
  /// A neighbour as seen from rank r: a particle that `rank` owns at x has a copy at x + shift in r's frame
  /// (shift != 0 where r looks across a periodic face; r's own particles can come back this way too).
  struct Image {
    Rank rank;
    Int3 shift;  ///< -1, 0 or 1 periods of each axis [quanta]
    friend bool operator==(const Image&, const Image&) = default;
  };
  /// All images of boxes, r's own box unshifted excepted, that leave a gap of less than `reach` to the box of
  /// r on every axis: these and no others can hold a position within `reach` of one of r's on every axis.
  /// Ordered by rank, then shift (lexicographic). Symmetric: (s, shift) is a neighbour of r if and only if
  /// (r, -shift) is one of s. Throws InputError if `reach` is a whole period or more.
  [[nodiscard]] std::vector<Image> neighbours(Rank r, std::int64_t reach) const;
  /// Ranks whose box intersects `box` (quanta; periodic axes wrap, unused axes are ignored); ascending, each
  /// once.
  [[nodiscard]] std::vector<Rank> ranks_touching(const Box& box) const;

 private:
  [[nodiscard]] std::size_t row_of(Rank r) const;

  CellGrid grid_;
  int row_axis_, column_axis_;
  Cuts cuts_;
  std::vector<std::int64_t> first_;  ///< first rank of each row, then the number of ranks
};

/// Number of columns of each row for `ranks` parts of a grid with the given cells along the two axes: near
/// square parts, equal columns when that costs at most 7 % more perimeter than the best shape (the seed's
/// form), else columns that differ by at most one between rows. Throws as uniform_cuts does.
[[nodiscard]] std::vector<int> jagged_shape(int ranks, std::int64_t row_cells, std::int64_t column_cells);
/// Largest rank count jagged_shape accepts for this grid; it accepts every smaller one too.
[[nodiscard]] std::int64_t max_ranks(std::int64_t row_cells, std::int64_t column_cells);
/// Parts of equal area as far as cell lines allow: the height of a row is proportional to its number of
/// columns. Throws InputError "... at most N ranks" when infeasible.
[[nodiscard]] Cuts uniform_cuts(int ranks, std::int64_t row_cells, std::int64_t column_cells);

}  // namespace decomp
