// What rows of wall particles have of the fluid beside them (terms/wall.hpp): its pressure, and a velocity that makes
// it slip or not.
#pragma once

#include <memory>

#include "sph/models/builder.hpp"
#include "sph/models/wall_mirror.hpp"

namespace sph {

struct WallPressures {
  static constexpr FieldSet reads{Field::wall_sums, Field::wall_sums_by_density, Field::group};
  static constexpr FieldSet writes{Field::pressure, Field::velocity, Field::wall_pressures,
                                   Field::wall_mirror};
  const Scene* scene;
  std::shared_ptr<const WallMirror> of_wall;  ///< where walls do not slip
  double density = 0;                         ///< of all fluids, 0 where they differ [kg/m^3]

  void operator()(const View<reads, writes>& particles, const Step& step) const;
};

/// Of the walls of a scene, with the fields that they need.
[[nodiscard]] WallPressures wall_pressures(Builder& builder);

}  // namespace sph
