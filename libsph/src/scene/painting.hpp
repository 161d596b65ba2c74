// Which group the regions of a start paint at a place.
#pragma once

#include <vector>

#include "sph/scene/scene.hpp"

namespace sph {

/// Monotonic in each axis' distance from the region's middle, as computed: a row of the lattice meets it in
/// one interval.
inline bool contains(const Region& r, const Double3& x, std::size_t dim) {
  if (r.shape == RegionShape::everywhere) return true;
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
