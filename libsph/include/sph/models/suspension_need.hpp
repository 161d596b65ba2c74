// What a scene of grains in melts will ask for, estimated from the scene alone.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "sph/scene/scene.hpp"

namespace sph {

struct SuspensionNeed {
  std::array<double, 2> cells_per_grain{};  ///< edge of a cell over the diameter, least and most
  double speed =
      0;  ///< of the fastest grain alone, up or down, in the thinnest melt and beside the most unlike one [m/s]
  double overlap = 0;     ///< in radii, at the floor of a bed of all grains
  double relaxation = 0;  ///< of a contact of two grains, the shortest [s]
};
/// `count`: grains of each group.
[[nodiscard]] SuspensionNeed suspension_need(const Scene& scene, std::span<const std::int64_t> count);

}  // namespace sph
