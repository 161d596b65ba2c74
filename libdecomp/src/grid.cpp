#include "decomp/grid.hpp"

#include <algorithm>

namespace decomp {

CellGrid::CellGrid(int dim, const Int3& origin, const Int3& length, const std::array<bool, 3>& periodic,
                   std::int64_t min_edge)
    : dim_(dim), origin_(origin), length_(length), cells_{1, 1, 1}, edge_{1, 1, 1}, periodic_{} {
  if (dim < 1 || dim > max_axes)
    throw InputError("a cell grid has 1 to 3 dimensions, not " + std::to_string(dim));
  if (min_edge < 1) throw InputError("the cell edge must be at least one position quantum");
  for (int a = 0; a < max_axes; ++a) {
    const std::string axis(1, "xyz"[a]);
    if (a >= dim) {
      edge_[a] = std::max<std::int64_t>(length[a], 1);
      continue;
    }
    if (length[a] < 1) throw InputError("the domain has no extent along " + axis);
    if (origin[a] < -max_coordinate || origin[a] > max_coordinate || length[a] > max_coordinate - origin[a])
      throw InputError("the domain along " + axis +
                       " exceeds 2^60 position quanta: choose a larger quantum or a nearer origin");
    const std::int64_t fit = length[a] / min_edge;
    if (periodic[a] && fit < 3)
      throw InputError("periodic axis " + axis + " has room for " + std::to_string(fit) +
                       " cells of the interaction range plus skin, but needs at least 3");
    periodic_[a] = periodic[a];
    cells_[a] = std::max<std::int64_t>(fit, 1);
    edge_[a] = length[a] / cells_[a];
  }
}

Int3 CellGrid::wrap(Int3 x) const {
  for (int a = 0; a < dim_; ++a) {
    if (!periodic_[a]) continue;
    std::int64_t offset = x[a] - origin_[a];
    if (offset >= 0 && offset < length_[a]) continue;  // nearly always: saves the division
    offset %= length_[a];
    x[a] = origin_[a] + (offset < 0 ? offset + length_[a] : offset);
  }
  return x;
}

bool CellGrid::inside(const Int3& x) const {
  for (int a = 0; a < dim_; ++a)
    if (!periodic_[a] && (x[a] < origin_[a] || x[a] >= origin_[a] + length_[a])) return false;
  return true;
}

Int3 CellGrid::cell_of(const Int3& x) const {
  Int3 cell{};
  for (int a = 0; a < dim_; ++a)  // truncation towards 0 rounds -edge < offset < 0 up, which is cell 0 anyway
    cell[a] = std::clamp<std::int64_t>((x[a] - origin_[a]) / edge_[a], 0, cells_[a] - 1);
  return cell;
}

std::int64_t CellGrid::line(int axis, std::int64_t index) const {
  return index == cells_[axis] ? origin_[axis] + length_[axis] : origin_[axis] + index * edge_[axis];
}

}  // namespace decomp
