// Between a grid and one of twice as wide cells: linear along and across, restriction the transpose over 2^dim.
#pragma once

#include "stokes/grid.hpp"

namespace stokes {

/// Arithmetic means of the 2^dim cells of `fine` in each of `coarse`.
void mean_of_cells(const Patch& fine, const Field& cells, const Patch& coarse, Field& means);
/// Of the component along `axis`; the copies of r are up to date.
void restrict_faces(const Patch& fine, int axis, const Field& r, const Patch& coarse, Field& out);
/// The copies of `coarse` are up to date.
void add_prolonged(const Patch& coarse_patch, int axis, const Field& coarse, const Patch& fine, Field& u);

}  // namespace stokes
