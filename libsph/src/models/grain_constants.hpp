// Constants of the contacts of two materials, and what bounds the time step with them.
#pragma once

#include <array>
#include <optional>

#include "sph/scene/scene.hpp"

namespace sph {

/// Of groups a and b, in the order of ContactConstants::row; the time step in them is `dt`.
[[nodiscard]] std::array<double, 8> constants_of(const Scene& scene, std::size_t a, std::size_t b, double dt);

/// Of all pairs, of two grains of that radius at an overlap in radii, the largest allowed if none is given: dF/d(delta) [N/m].
[[nodiscard]] double stiffest_contact(const Scene& scene, double radius, std::optional<double> overlap = {});

}  // namespace sph
