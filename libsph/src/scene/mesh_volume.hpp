// What lies inside closed triangles: a place from which a ray meets them an odd number of times. A ray along each axis is asked and the
// majority counts, so that a gap, which one ray may slip through, does not turn a row of places inside out. A triangle's edges belong to
// it as those of a box do, lower <= x < upper, and two triangles, or polygons, judge their common edge by the same numbers: no ray passes between.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sph/scene/scene.hpp"

namespace sph {

class MeshVolume {
 public:
  using Corners = std::array<std::uint32_t, 3>;

  MeshVolume(std::vector<Double3> vertices, std::vector<Corners> corners);

  [[nodiscard]] bool contains(const Double3& x) const;
  [[nodiscard]] const Double3& lower() const { return lower_; }
  [[nodiscard]] const Double3& upper() const { return upper_; }
  [[nodiscard]] std::size_t size() const { return corners_.size(); }  ///< triangles
  /// Edges that have one triangle, or another odd number: 0 if the surface is closed.
  [[nodiscard]] std::size_t open_edges() const;
  [[nodiscard]] std::size_t bytes() const;

 private:
  /// The triangles that a ray along an axis may meet, by the square of the plane across it that the ray passes.
  struct Across {
    std::array<std::size_t, 2> count{};
    std::array<double, 2> per_length{};
    std::vector<std::uint32_t> first;
    std::vector<std::uint32_t> triangles;
  };

  void sort(std::size_t axis);
  [[nodiscard]] std::size_t square(std::size_t axis, std::size_t other, double x) const;
  [[nodiscard]] bool is_odd(std::size_t axis, const Double3& x) const;
  [[nodiscard]] bool is_before(std::size_t axis, const Corners& triangle, const Double3& x) const;

  std::vector<Double3> vertices_;
  std::vector<Corners> corners_;
  Double3 lower_{}, upper_{};
  std::array<Across, 3> across_;
};

/// The two axes across one.
[[nodiscard]] constexpr std::array<std::size_t, 2> others(std::size_t axis) {
  return {(axis + 1) % 3, (axis + 2) % 3};
}

/// Whether the edge from u to v passes at a greater first coordinate than x has at the same second one, lower <= x < upper.
[[nodiscard]] inline bool passes_beyond(const std::array<double, 2>& u, const std::array<double, 2>& v,
                                        const std::array<double, 2>& x) {
  if ((u[1] > x[1]) == (v[1] > x[1])) return false;
  const auto &low = u[1] < v[1] ? u : v, &high = u[1] < v[1] ? v : u;  // whichever way round it is gone
  return x[0] < low[0] + (x[1] - low[1]) * (high[0] - low[0]) / (high[1] - low[1]);
}

}  // namespace sph
