// Who has which cells of a grid: an even jagged partition of its tiles, of its own, since the particles' cuts follow
// grains. A tile is halved as often as its width allows without a cut through a coarse cell.
#pragma once

#include <vector>

#include "stokes/grid.hpp"

namespace stokes {

inline constexpr std::int64_t tile = 8;  ///< cells along an axis; less where there are fewer

/// Boxes of all ranks, those beyond as many as there are tiles for being empty.
[[nodiscard]] std::vector<Box> even_boxes(const Grid& grid, int ranks);

}  // namespace stokes
