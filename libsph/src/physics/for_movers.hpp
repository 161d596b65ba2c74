// Rows that move, interior and boundary.
#pragma once

#include "sph/neighbour_lists.hpp"

namespace sph {

template <class Function>
void for_movers(const RowRanges& ranges, Function function) {
  for (RowClass c : {RowClass::interior_movers, RowClass::boundary_movers}) {
    const RowRange& r = ranges[static_cast<std::size_t>(c)];
    for (std::size_t i = r.first; i < r.last; ++i) function(i);
  }
}

}  // namespace sph
