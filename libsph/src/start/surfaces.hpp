// The surfaces of a scene's meshes, from their files.
#pragma once

#include <memory>
#include <vector>

#include "decomp/comm.hpp"
#include "sph/pairs/triangle_surface.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

/// Each about the centre of its motion [m]. Throws InputError where one is broken, or another than the run began with.
/// Collective.
[[nodiscard]] std::vector<std::shared_ptr<const TriangleSurface>> read_surfaces(const decomp::Comm& comm,
                                                                                const Scene& scene);

}  // namespace sph
