// The grid of a scene of melts.
#pragma once

#include <array>
#include <cstddef>

#include "sph/scene/scene.hpp"
#include "stokes/grid.hpp"

namespace sph {

/// The first melt and the last, which is the first where there is but one, as indices of groups.
[[nodiscard]] std::array<std::size_t, 2> melts_of(const Scene& scene);
/// Its cells fill the domain.
[[nodiscard]] stokes::Grid melt_grid(const Scene& scene);

}  // namespace sph
