// The grid of a scene of melts.
#pragma once

#include "sph/scene/scene.hpp"
#include "stokes/grid.hpp"

namespace sph {

/// Its cells fill the domain.
[[nodiscard]] stokes::Grid melt_grid(const Scene& scene);

}  // namespace sph
