// Rows that move and rows of walls, interior and boundary; largest values of rows.
#pragma once

#include <cmath>
#include <initializer_list>

#include "sph/pairs/neighbour_lists.hpp"

namespace sph {

template <class Function>
void for_rows(const RowRanges& ranges, std::initializer_list<RowClass> classes, Function function) {
  for (RowClass c : classes) {
    const RowRange& r = ranges[static_cast<std::size_t>(c)];
    for (std::size_t i = r.first; i < r.last; ++i) function(i);
  }
}

template <class Function>
void for_movers(const RowRanges& ranges, Function function) {
  for_rows(ranges, {RowClass::interior_movers, RowClass::boundary_movers}, function);
}

template <class Function>
void for_walls(const RowRanges& ranges, Function function) {
  for_rows(ranges, {RowClass::interior_walls, RowClass::boundary_walls}, function);
}

/// Of two; a NaN stays one, so that it is noticed.
[[nodiscard]] inline double larger(double x, double maximum) {
  return x > maximum || std::isnan(x) ? x : maximum;
}

}  // namespace sph
