// A staggered grid (Harlow & Welch 1965) over a box: a cell owns its centre (pressure, viscosity), the faces on its lower
// sides (the component of the velocity across each) and its lower edges (the viscosity of shear).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "decomp/types.hpp"

namespace stokes {

using decomp::Box;
using decomp::Int3;

/// What a pair of opposite faces of the domain does, or one of them.
enum class Side : std::uint8_t { periodic, free_slip, no_slip };

struct Grid {
  int dim = 2;                                 ///< 2 or 3
  Int3 cells{1, 1, 1};                         ///< 1 along axes beyond dim
  std::array<double, 3> edge{1, 1, 1};         ///< of a cell [m]
  std::array<std::array<Side, 2>, 3> sides{};  ///< [axis][lower, upper]; periodic: both
  [[nodiscard]] bool periodic(int axis) const {
    return sides[static_cast<std::size_t>(axis)][0] == Side::periodic;
  }
  [[nodiscard]] std::array<bool, 3> periodic_axes() const;
  [[nodiscard]] Box box() const { return {{}, cells}; }
  /// Of a cell [m^dim].
  [[nodiscard]] double volume() const { return dim == 3 ? edge[0] * edge[1] * edge[2] : edge[0] * edge[1]; }
  /// Twice as wide cells; all axes must have an even number.
  [[nodiscard]] Grid halved() const;
  /// Of axis `a` a constant velocity meets no resistance: its mean is free.
  [[nodiscard]] bool slides(int axis) const;
};

/// One rank's cells with layers of copies around them.
struct Patch {
  Patch(const Grid& grid, const Box& own, int layers = 1);

  [[nodiscard]] std::ptrdiff_t at(std::int64_t x, std::int64_t y, std::int64_t z) const {
    return (x - frame.lo[0]) + (y - frame.lo[1]) * stride[1] + (z - frame.lo[2]) * stride[2];
  }
  [[nodiscard]] std::ptrdiff_t at(const Int3& x) const { return at(x[0], x[1], x[2]); }
  /// The rank's cells touch the domain's lower (0) or upper (1) face, which is a wall.
  [[nodiscard]] bool at_wall(int axis, int side) const;

  Grid grid;
  Box own, frame;
  int layers = 1;
  std::array<std::ptrdiff_t, 3> stride{};
  std::size_t size = 0;  ///< of the frame
};

/// The cells and copies of each rank's patch: what a halo exchange fills. Copies behind walls nobody has.
[[nodiscard]] std::vector<Box> frames_of(const Grid& grid, std::vector<Box> boxes, int layers = 1);

using Field = std::vector<double>;  ///< over a patch's frame
using Velocity = std::array<Field, 3>;

/// What lies behind walls of the copies: velocities vanish across them and have their mirror image along them, opposite
/// where there is no slip; the rest is mirrored. Of velocities one layer.
void mirror_velocity(const Patch& patch, Velocity& u);
void mirror_cells(const Patch& patch, Field& c);
/// In the nearest layer behind a side of the domain, as far as the patch has it: factor c + shift, c in the cell at it.
void set_behind(const Patch& patch, int axis, int side, double factor, double shift, Field& c);

/// work(index of the first cell, number of cells) for each line of the rank's own cells along x, and (y, z) of it.
template <class Work>
void for_lines(const Patch& p, Work work) {
  if (p.own.empty()) return;
  for (std::int64_t z = p.own.lo[2]; z < p.own.hi[2]; ++z)
    for (std::int64_t y = p.own.lo[1]; y < p.own.hi[1]; ++y)
      work(p.at(p.own.lo[0], y, z), p.own.hi[0] - p.own.lo[0], y, z);
}
/// work(index) for each of the rank's own cells.
template <class Work>
void for_own(const Patch& p, Work work) {
  for_lines(p, [&](std::ptrdiff_t first, std::int64_t n, std::int64_t, std::int64_t) {
    for (std::ptrdiff_t k = first; k < first + n; ++k) work(k);
  });
}

}  // namespace stokes
