// A plane or facet beside a grain, as a sweep sees it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "sph/pairs/contact_context.hpp"

namespace sph {

struct WallSide {
  double distance;  ///< of the grain's centre [m]
  const double *away, *velocity;
  std::uint32_t group;
  std::size_t number;  ///< of the plane, or after them all of the mesh
  bool touchable;
  double lightness;  ///< 1 / mass of what the contact moves, 0 of a wall that does as it is told [1/kg]
};

/// `entry` of the list of walls; `line` of the grain's motion.
[[gnu::always_inline]] inline WallSide wall_side(const ContactContext& c, std::uint32_t wall,
                                                 std::size_t entry, const double* line) {
  if (wall < c.walls.planes.size()) {
    const PlaneNow& plane = c.walls.planes[wall];
    const std::array<std::int64_t, 3> x = position_in(line);
    double away = 0;
    for (std::size_t a = 0; a < 3; ++a) away += static_cast<double>(x[a] - plane.point[a]) * plane.normal[a];
    return {away * c.quantum.length,
            plane.normal.data(),
            plane.velocity.data(),
            plane.group,
            wall,
            plane.present,
            0};
  }
  static constexpr double none[3] = {};
  const FacetContact* f = c.walls.facets->any() ? c.walls.facets->at(entry) : nullptr;
  if (f == nullptr) return {0, none, none, 0, 0, false, 0};
  const MeshNow& mesh = c.walls.facets->meshes()[f->mesh];
  double along = 0;
  for (std::size_t a = 0; a < 3; ++a) along += f->away[a] * mesh.lightness[a];
  return {f->distance, f->away.data(), f->velocity.data(), mesh.group, c.walls.planes.size() + f->mesh,
          true,        along * along};
}

}  // namespace sph
