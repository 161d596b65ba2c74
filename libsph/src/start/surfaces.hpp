// The surfaces of a scene's meshes, from their files.
#pragma once

#include <vector>

#include "decomp/comm.hpp"
#include "sph/pairs/triangle_surface.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

/// Each about the centre of its motion [m]. Rank 0 reads the files, each machine holds one copy. Throws InputError where one is broken,
/// or another than the run began with. Collective.
[[nodiscard]] std::vector<TriangleSurface> read_surfaces(const decomp::Comm& comm, const Scene& scene);

}  // namespace sph
