// Which owned rows a neighbouring box needs. Most rows lie deep inside their own box: one pass discards
// them, and only the rest is tested against each neighbour.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "decomp/types.hpp"

namespace decomp {

class RowSelector {
 public:
  /// `x` has dim coordinates a row and must outlive the selector. Throws GuardError if a row is not in `own`.
  RowSelector(const std::int64_t* x, std::size_t rows, int dim, const Box& own, std::int64_t reach);

  /// Appends, in ascending order, the rows that x + shift brings to within `reach` of `box` on every axis:
  /// no further than `reach` from some quantum of the box.
  void select(const Box& box, const Int3& shift, std::vector<std::uint32_t>& rows) const;

 private:
  const std::int64_t* x_;
  int dim_;
  std::int64_t reach_;
  std::vector<std::uint32_t> near_face_;  ///< rows within reach of a face of the own box
};

}  // namespace decomp
