// Which group the regions of a start paint at a place.
#pragma once

#include <vector>

#include "scene/mesh_volume.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

/// The coordinate along which the axis of a cylinder or cone is.
[[nodiscard]] inline std::size_t axis_of(const Region& r) {
  return r.from[0] != r.to[0] ? 0 : r.from[1] != r.to[1] ? 1 : 2;
}
/// Of its axis from `from` to `to`: from 0 to 1.
[[nodiscard]] inline double part_of_axis(const Region& r, double x) {
  const std::size_t a = axis_of(r);
  return (x - r.from[a]) / (r.to[a] - r.from[a]);
}
/// Of a cylinder or cone there.
[[nodiscard]] inline double radius_at(const Region& r, double part) {
  return r.shape == RegionShape::cylinder ? r.radius : r.radius + (r.top_radius - r.radius) * part;
}
/// Squared, of a place from the axis.
[[nodiscard]] inline double from_axis2(const Region& r, const Double3& x, std::size_t dim) {
  double distance2 = 0;
  for (std::size_t a = 0; a < dim; ++a)
    if (a != axis_of(r)) distance2 += (x[a] - r.from[a]) * (x[a] - r.from[a]);
  return distance2;
}

/// Whether a row of the lattice may leave a region and meet it again.
[[nodiscard]] inline bool has_bays(const Region& r) {
  return r.shape == RegionShape::polygon || r.shape == RegionShape::mesh;
}
[[nodiscard]] inline bool is_in_polygon(const Region& r, const Double3& x) {
  bool inside = false;
  for (std::size_t k = 0; k < r.points.size(); ++k)
    inside ^= passes_beyond(r.points[k], r.points[(k + 1) % r.points.size()], {x[0], x[1]});
  return inside;
}

/// Without bays monotonic in each axis' distance from the region's middle, as computed: a row of the lattice meets it in
/// one interval.
inline bool contains(const Region& r, const Double3& x, std::size_t dim) {
  if (r.shape == RegionShape::everywhere) return true;
  if (r.shape == RegionShape::polygon) return is_in_polygon(r, x);
  if (r.shape == RegionShape::mesh) return r.mesh.volume != nullptr && r.mesh.volume->contains(x);
  if (r.shape == RegionShape::cylinder || r.shape == RegionShape::cone) {
    const double part = part_of_axis(r, x[axis_of(r)]), radius = radius_at(r, part);
    return part >= 0 && part < 1 && from_axis2(r, x, dim) < radius * radius;
  }
  double distance2 = 0;
  for (std::size_t a = 0; a < dim; ++a) {
    if (r.shape == RegionShape::box && (x[a] < r.lower[a] || x[a] >= r.upper[a])) return false;
    distance2 += (x[a] - r.centre[a]) * (x[a] - r.centre[a]);
  }
  return r.shape == RegionShape::box || distance2 < r.radius * r.radius;
}

/// The last region of the scene's lattice that contains x [m]; -1 leaves it empty.
[[nodiscard]] inline int painted_group(const Scene& scene, const Double3& x) {
  const std::vector<Region>& regions = scene.start.lattice.regions;
  for (auto r = regions.rbegin(); r != regions.rend(); ++r)
    if (contains(*r, x, static_cast<std::size_t>(scene.dim))) return r->group;
  return -1;
}

}  // namespace sph
