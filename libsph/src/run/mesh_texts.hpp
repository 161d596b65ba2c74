// What `check` and a start say of triangle meshes.
#pragma once

#include <string>
#include <vector>

#include "sph/models/parts.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

/// How large each wall is: tells whether its unit is right.
[[nodiscard]] std::string mesh_text(const Scene& scene, const Parts& parts);

/// A line for each region of the start whose surface is not closed.
[[nodiscard]] std::vector<std::string> open_regions(const Scene& scene);

}  // namespace sph
