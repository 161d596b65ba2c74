// Viscosity of magma: that of its liquid, times what crystals and bubbles make of it. Hess & Dingwell (1996), eq. 7, w
// the dissolved water in percent of the mass:
//   log10 eta = -3.545 + 0.833 ln w + (9601 - 2368 ln w) / (T - (195.7 + 32.25 ln w))
#pragma once

#include "sph/scene/group_scene.hpp"

namespace sph {

struct MeltState {
  double temperature = 0;    ///< [K]
  double water = 0;          ///< dissolved, over the mass
  double crystals = 0;       ///< frozen share
  double void_fraction = 0;  ///< gas's share of the volume
};

/// [Pa s]; infinite where the law has no end and `most` sets none.
[[nodiscard]] double melt_viscosity(const Group& group, const MeltState& state);

/// At the temperature that the group begins with, with all volatiles dissolved.
[[nodiscard]] double viscosity_at_start(const Group& group);

}  // namespace sph
