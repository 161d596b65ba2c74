// Tells most triangles that are too far away without a root or a division.
#pragma once

#include <algorithm>

#include "sph/pairs/triangle_surface.hpp"

namespace sph {

/// The box of the triangle is further from x than `reach`, by more than nearest points are rounded.
inline bool lies_beyond(const TriangleSurface& surface, std::size_t triangle, const Point3& x, double reach) {
  const auto& [u, v, w] = surface.triangles()[triangle];
  const Point3 &a = surface.vertices()[u], &b = surface.vertices()[v], &c = surface.vertices()[w];
  double square = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double least = std::min(std::min(a[k], b[k]), c[k]), most = std::max(std::max(a[k], b[k]), c[k]);
    const double away = std::max(std::max(least - x[k], x[k] - most), 0.0);
    square += away * away;
  }
  return square > 1.0002 * reach * reach;
}

}  // namespace sph
