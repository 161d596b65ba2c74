// Who has which cells of a grid: an even jagged partition of its tiles, of its own, since the particles' cuts follow
// grains. A tile is halved as often as its width allows without a cut through a coarse cell.
#pragma once

#include <vector>

#include "stokes/grid.hpp"

namespace stokes {

inline constexpr std::int64_t tile = 8;  ///< cells along an axis; less where there are fewer

/// Boxes of all ranks, those beyond as many as there are tiles for being empty.
[[nodiscard]] std::vector<Box> even_boxes(const Grid& grid, int ranks);

inline constexpr std::int64_t least_coarsest = 4;  ///< cells along the shortest axis of the coarsest grid
/// Halved as long as its cells are even in number and not too few.
[[nodiscard]] Grid coarsest_grid(Grid grid);

/// A grid of twice as wide cells. Its values are first where their finer ones are, `halves`, then go down to those who have
/// them, `boxes`, and what is found of them back up to those around `halves`.
struct CoarseGrid {
  Grid grid;
  bool everywhere = false;  ///< every rank has all of it, and nothing goes back
  std::vector<Box> halves, boxes;
};
/// All that follow from the finest grid, whose boxes are those of all ranks, down to the coarsest.
[[nodiscard]] std::vector<CoarseGrid> coarse_grids(const Grid& finest, const std::vector<Box>& boxes);

}  // namespace stokes
