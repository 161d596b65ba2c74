// The start's lattice in index space and the regions that paint it. Square: cell centres. Close
// packings have the same area or volume per point as the square lattice of that spacing: hexagonal (2D), rows of
// alternating offset, and face-centred cubic (3D), of cubes of edge a with 4 points, neighbours a / sqrt(2) apart.
#pragma once

#include <algorithm>
#include <cmath>

#include "decomp/types.hpp"
#include "scene/grain_fill.hpp"
#include "sph/scene/melt_grid.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

class Lattice {
 public:
  explicit Lattice(const Scene& scene)
      : fill_(scene.start.lattice), dim_(static_cast<std::size_t>(scene.dim)) {
    step_.fill(scene.start.spacing);
    if (scene.has_melt()) step_ = melt_grid(scene).edge;
    if (fill_.kind == LatticeKind::hexagonal) {
      if (scene.dim != 2) throw InputError("start.lattice: \"hexagonal\" exists in 2D only; use \"square\"");
      // a^2 sqrt(3)/2 = spacing^2
      step_[0] = scene.start.spacing * std::sqrt(2 / std::sqrt(3.0));
      step_[1] = step_[0] * (0.5 * std::sqrt(3.0));
    }
    if (fill_.kind == LatticeKind::fcc) {
      step_[0] = scene.start.spacing * fcc_edge;
      step_[1] = step_[2] = 0.5 * step_[0];
    }
    // No point on an edge, and of a period none twice.
    const bool round = fill_.kind == LatticeKind::hexagonal && scene.domain.periodic[0] &&
                       fill_.lower[0] == scene.domain.lower[0] && fill_.upper[0] == scene.domain.upper[0];
    if (round || fill_.kind == LatticeKind::fcc) aside_ = 0.25 * step_[0];
    for (std::size_t a = 0; a < dim_; ++a) {
      // A margin of one point: whether a point is inside is decided on its coordinate.
      first_[a] = static_cast<std::int64_t>(std::floor((fill_.lower[a] - fill_.origin[a]) / step_[a])) - 1;
      count_[a] =
          static_cast<std::int64_t>(std::ceil((fill_.upper[a] - fill_.origin[a]) / step_[a])) + 1 - first_[a];
    }
  }
  [[nodiscard]] std::int64_t first(std::size_t axis) const { return first_[axis]; }
  [[nodiscard]] std::int64_t count(std::size_t axis) const { return count_[axis]; }
  /// Lattice index just below a coordinate.
  [[nodiscard]] std::int64_t below(std::size_t axis, double x) const {
    return static_cast<std::int64_t>(std::floor((x - fill_.origin[axis]) / step_[axis])) - 1;
  }
  [[nodiscard]] Double3 point(const decomp::Int3& k) const {
    Double3 x{};
    for (std::size_t a = 0; a < dim_; ++a)
      x[a] = fill_.origin[a] + (static_cast<double>(k[a]) + 0.5) * step_[a];
    const bool odd = ((k[1] + k[2]) & 1) != 0;
    if (fill_.kind != LatticeKind::square && odd) x[0] += 0.5 * step_[0];
    x[0] -= aside_;
    return x;
  }
  [[nodiscard]] bool inside(const Double3& x) const {
    for (std::size_t a = 0; a < dim_; ++a)
      if (x[a] < fill_.lower[a] || x[a] >= fill_.upper[a]) return false;
    return true;
  }
  [[nodiscard]] std::uint64_t id(const decomp::Int3& k) const {
    std::uint64_t n = 0;
    for (std::size_t a = dim_; a-- > 0;)
      n = n * static_cast<std::uint64_t>(count_[a]) + static_cast<std::uint64_t>(k[a] - first_[a]);
    return n;
  }

 private:
  const LatticeFill& fill_;
  std::size_t dim_;
  Double3 step_{};
  double aside_ = 0;
  decomp::Int3 first_{}, count_{1, 1, 1};
};

/// Of the first point of a fill: ids of fills follow on those of the lattice, one fill after the other.
[[nodiscard]] inline std::uint64_t first_id(const Scene& scene, const GrainFill& fill) {
  const Lattice lattice(scene);
  std::uint64_t id = 1;
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dim); ++a)
    id *= static_cast<std::uint64_t>(lattice.count(a));
  for (const GrainFill& before : scene.start.fills) {
    if (&before == &fill) break;
    id += static_cast<std::uint64_t>(count(before));
  }
  return id;
}

}  // namespace sph
