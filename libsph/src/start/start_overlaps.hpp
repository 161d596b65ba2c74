// Grains that a start puts deeper into each other, or into a wall, than contact.largest_overlap allows are
// wrong input: the first step would find them too, but not in which rows they stand.
#pragma once

#include <span>

#include "decomp/comm.hpp"
#include "sph/core/particles.hpp"
#include "sph/pairs/contact_lists.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

/// Lists and halo as a rebuild leaves them. Throws InputError on all ranks, naming the pair with the lowest
/// ids. Collective.
void refuse_overlaps(const decomp::Comm& comm, const Scene& scene, const PositionScale& scale,
                     const Particles& particles, const ContactLists& lists, const WallsNow& walls);

/// False only for a lattice whose grains cannot lie that close to each other and to planes, wherever jitter and
/// radii put them, in a scene without meshes.
[[nodiscard]] bool may_overlap(const Scene& scene);

}  // namespace sph
