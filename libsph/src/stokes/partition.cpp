#include "stokes/partition.hpp"

#include <algorithm>

#include "decomp/partition.hpp"

namespace stokes {
namespace {

/// The largest power of two up to `tile` that divides the cells of an axis.
std::int64_t tile_of(std::int64_t cells) {
  std::int64_t t = tile;
  while (cells % t != 0) t /= 2;
  return t;
}

}  // namespace

std::vector<Box> even_boxes(const Grid& grid, int ranks) {
  const std::int64_t row = tile_of(grid.cells[0]), column = tile_of(grid.cells[1]);
  const std::int64_t rows = grid.cells[0] / row, columns = grid.cells[1] / column;
  const auto parts = static_cast<int>(std::min<std::int64_t>(ranks, decomp::max_ranks(rows, columns)));
  const decomp::Cuts cuts = decomp::uniform_cuts(parts, rows, columns);
  std::vector<Box> boxes;
  for (std::size_t r = 0; r + 1 < cuts.row.size(); ++r)
    for (std::size_t c = 0; c + 1 < cuts.column[r].size(); ++c)
      boxes.push_back({{cuts.row[r] * row, cuts.column[r][c] * column, 0},
                       {cuts.row[r + 1] * row, cuts.column[r][c + 1] * column, grid.cells[2]}});
  boxes.resize(static_cast<std::size_t>(ranks));
  return boxes;
}

}  // namespace stokes
