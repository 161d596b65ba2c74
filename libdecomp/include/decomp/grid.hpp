// The global cell grid, anchored at the domain corner. Cells are the quantum of every cut and the bins of
// the neighbour search: edge >= interaction range + skin, so partners sit in adjacent cells only.
#pragma once

#include <cstdint>
#include <vector>

#include "decomp/types.hpp"

namespace decomp {

class CellGrid {
 public:
  /// Coordinates are limited to +-2^60, so that no difference or image can overflow.
  static constexpr std::int64_t max_coordinate = std::int64_t{1} << 60;

  /// `length` and `min_edge` in quanta. The number of cells of an axis is floor(length / min_edge), at least
  /// 1; the last cell takes the remainder. Axes >= dim have one cell and are not periodic.
  /// Throws InputError when a periodic axis would have fewer than 3 cells.
  CellGrid(int dim, const Int3& origin, const Int3& length, const std::array<bool, 3>& periodic,
           std::int64_t min_edge);

  [[nodiscard]] int dim() const { return dim_; }
  [[nodiscard]] const Int3& origin() const { return origin_; }
  [[nodiscard]] const Int3& length() const { return length_; }
  [[nodiscard]] const std::array<bool, 3>& periodic() const { return periodic_; }
  [[nodiscard]] const Int3& cells() const { return cells_; }
  [[nodiscard]] const Int3& edge() const { return edge_; }  ///< of every cell but the last, which is longer

  /// Brings x into [origin, origin + length) on periodic axes: exact. Other axes are left alone.
  [[nodiscard]] Int3 wrap(Int3 x) const;
  [[nodiscard]] bool inside(const Int3& x) const;  ///< within the domain on every non-periodic axis
  /// Cell of a wrapped position; positions outside a non-periodic axis go to its first or last cell.
  [[nodiscard]] Int3 cell_of(const Int3& x) const;
  /// Corner coordinate [quanta] of a cell line 0..cells(a) of axis a.
  [[nodiscard]] std::int64_t line(int axis, std::int64_t index) const;

 private:
  int dim_;
  Int3 origin_, length_, cells_, edge_;
  std::array<bool, 3> periodic_;
};

/// Position of a cell along the Hilbert curve of order `bits` (J. Skilling, AIP Conf. Proc. 707, 381, 2004).
/// Bijective on [0, 2^bits)^dim, dim 1 to 3, dim * bits <= 64; consecutive keys are cells that share a face.
[[nodiscard]] std::uint64_t hilbert_key(int dim, int bits, const Int3& cell);
[[nodiscard]] Int3 hilbert_cell(int dim, int bits, std::uint64_t key);
/// For each cell of `box` (x fastest), which lies in [0, 2^bits)^dim: its place among them along the curve.
[[nodiscard]] std::vector<std::uint32_t> hilbert_places(int dim, int bits, const Box& box);

}  // namespace decomp
