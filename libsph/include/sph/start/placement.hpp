// The start: particles on a lattice painted by the scene's regions, with their initial fields. Ids follow
// from the lattice index alone; each rank places only what lies in its own box. Or particles from a file.
#pragma once

#include "sph/core/particles.hpp"
#include "sph/plan/distribution.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

/// Fills `particles` (empty) with this rank's share. Collective. Throws InputError if the file is wrong.
void place_particles(const Scene& scene, const PositionScale& scale, Distribution& distribution,
                     Particles& particles);

}  // namespace sph
