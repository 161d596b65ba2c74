#include "stokes/partition.hpp"

#include <algorithm>

#include "decomp/box_exchange.hpp"
#include "decomp/partition.hpp"

namespace stokes {
namespace {

/// The largest power of two up to `tile` that divides the cells of an axis.
std::int64_t tile_of(std::int64_t cells) {
  std::int64_t t = tile;
  while (cells % t != 0) t /= 2;
  return t;
}

constexpr std::int64_t on_all_ranks = 4096;  // as few cells every rank has

bool can_be_halved(const Grid& g) {
  for (std::size_t a = 0; a < static_cast<std::size_t>(g.dim); ++a)
    if (g.cells[a] % 2 != 0 || g.cells[a] / 2 < least_coarsest) return false;
  return true;
}

bool are_even(const std::vector<Box>& boxes, int dim) {
  return std::ranges::all_of(boxes, [&](const Box& b) {
    for (std::size_t a = 0; a < static_cast<std::size_t>(dim); ++a)
      if (b.lo[a] % 2 != 0 || b.hi[a] % 2 != 0) return false;
    return true;
  });
}

std::vector<Box> halves_of(std::vector<Box> boxes, int dim) {
  for (Box& b : boxes)
    for (std::size_t a = 0; a < static_cast<std::size_t>(dim); ++a) b.lo[a] /= 2, b.hi[a] /= 2;
  return boxes;
}

}  // namespace

Grid coarsest_grid(Grid grid) {
  while (can_be_halved(grid)) grid = grid.halved();
  return grid;
}

std::vector<CoarseGrid> coarse_grids(const Grid& finest, const std::vector<Box>& boxes) {
  std::vector<CoarseGrid> out;
  Grid grid = finest;
  std::vector<Box> fine = boxes;
  while (can_be_halved(grid)) {
    grid = grid.halved();
    const auto ranks = static_cast<int>(fine.size());
    CoarseGrid next{
        grid, decomp::cell_count(grid.box()) <= on_all_ranks, halves_of(std::move(fine), grid.dim), {}};
    if (next.everywhere)
      next.boxes.assign(next.halves.size(), grid.box());
    else
      next.boxes =
          are_even(next.halves, grid.dim) ? next.halves : even_boxes(grid, ranks / (1 << grid.dim) + 1);
    next.boxes.resize(static_cast<std::size_t>(ranks));
    fine = next.everywhere ? std::vector<Box>{grid.box()} : next.boxes;
    out.push_back(std::move(next));
  }
  return out;
}

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
