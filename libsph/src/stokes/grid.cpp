#include "stokes/grid.hpp"

#include <algorithm>
#include <stdexcept>

namespace stokes {
namespace {

/// work(index of the first of a line of the frame along `axis`).
template <class Work>
void for_frame_lines(const Patch& p, std::size_t axis, Work work) {
  Box face = p.frame;
  face.hi[axis] = face.lo[axis] + 1;
  for (std::int64_t z = face.lo[2]; z < face.hi[2]; ++z)
    for (std::int64_t y = face.lo[1]; y < face.hi[1]; ++y)
      for (std::int64_t x = face.lo[0]; x < face.hi[0]; ++x) work(p.at(x, y, z));
}

}  // namespace

std::array<bool, 3> Grid::periodic_axes() const {
  return {dim > 0 && periodic(0), dim > 1 && periodic(1), dim > 2 && periodic(2)};
}

Grid Grid::halved() const {
  Grid g = *this;
  for (std::size_t a = 0; a < static_cast<std::size_t>(dim); ++a) {
    if (g.cells[a] % 2 != 0) throw std::logic_error("a grid of an odd number of cells is not halved");
    g.cells[a] /= 2;
    g.edge[a] *= 2;
  }
  return g;
}

bool Grid::slides(int axis) const {
  if (!periodic(axis)) return false;
  for (int a = 0; a < dim; ++a)
    for (const Side s : sides[static_cast<std::size_t>(a)])
      if (s == Side::no_slip) return false;
  return true;
}

Patch::Patch(const Grid& of, const Box& cells, int copies)
    : grid(of), own(cells), frame(cells), layers(copies) {
  for (std::size_t a = 0; a < static_cast<std::size_t>(grid.dim); ++a)
    frame.lo[a] -= layers, frame.hi[a] += layers;
  if (own.empty()) frame = own;
  std::ptrdiff_t n = 1;
  for (std::size_t a = 0; a < 3; ++a) {
    stride[a] = n;
    n *= own.empty() ? 0 : frame.hi[a] - frame.lo[a];
  }
  size = static_cast<std::size_t>(n);
}

bool Patch::at_wall(int axis, int side) const {
  const auto a = static_cast<std::size_t>(axis);
  if (grid.periodic(axis) || own.empty()) return false;
  return side == 0 ? own.lo[a] == 0 : own.hi[a] == grid.cells[a];
}

std::vector<Box> frames_of(const Grid& grid, std::vector<Box> boxes, int layers) {
  for (Box& b : boxes) b = Patch(grid, b, layers).frame;
  return boxes;
}

void mirror_velocity(const Patch& p, Velocity& u) {
  for (int axis = 0; axis < p.grid.dim; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const std::ptrdiff_t s = p.stride[a],
                         last = p.own.hi[a] - p.own.lo[a] + 1;  // the copy above the rank's cells
    for (std::size_t c = 0; c < static_cast<std::size_t>(p.grid.dim); ++c)
      for (int side = 0; side < 2; ++side) {
        if (!p.at_wall(axis, side)) continue;
        const double image = p.grid.sides[a][static_cast<std::size_t>(side)] == Side::free_slip ? 1 : -1;
        double* v = u[c].data();
        if (a != c && side == 0) for_frame_lines(p, a, [&](std::ptrdiff_t k) { v[k] = image * v[k + s]; });
        if (a != c && side == 1)
          for_frame_lines(p, a, [&](std::ptrdiff_t k) { v[k + last * s] = image * v[k + (last - 1) * s]; });
        if (a == c && side == 0) for_frame_lines(p, a, [&](std::ptrdiff_t k) { v[k] = v[k + s] = 0; });
        if (a == c && side == 1) for_frame_lines(p, a, [&](std::ptrdiff_t k) { v[k + last * s] = 0; });
      }
  }
}

void mirror_cells(const Patch& p, Field& c) {
  if (p.own.empty()) return;
  for (int axis = 0; axis < p.grid.dim; ++axis) {
    if (p.grid.periodic(axis)) continue;
    const auto a = static_cast<std::size_t>(axis);
    const std::int64_t n = p.grid.cells[a], lo = p.frame.lo[a];
    const auto mirror = [&](std::int64_t x, std::int64_t image) {
      const std::ptrdiff_t to = (x - lo) * p.stride[a], from = (image - lo) * p.stride[a];
      for_frame_lines(p, a, [&](std::ptrdiff_t k) { c[k + to] = c[k + from]; });
    };
    // A wall may also be behind the copies.
    for (std::int64_t x = lo; x < 0; ++x) mirror(x, std::min(-1 - x, n - 1));
    for (std::int64_t x = n; x < p.frame.hi[a]; ++x) mirror(x, std::max(2 * n - 1 - x, std::int64_t{0}));
  }
}

void set_behind(const Patch& p, int axis, int side, double factor, double shift, Field& c) {
  const auto a = static_cast<std::size_t>(axis);
  const std::int64_t at = side == 0 ? 0 : p.grid.cells[a] - 1, behind = side == 0 ? -1 : at + 1;
  if (p.own.empty() || behind < p.frame.lo[a] || behind >= p.frame.hi[a]) return;
  const std::ptrdiff_t from = (at - p.frame.lo[a]) * p.stride[a], to = (behind - p.frame.lo[a]) * p.stride[a];
  for_frame_lines(p, a, [&](std::ptrdiff_t k) { c[k + to] = factor * c[k + from] + shift; });
}

}  // namespace stokes
