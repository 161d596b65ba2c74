// The start: particles on a lattice painted by the scene's regions, with their initial fields. Ids follow
// from the lattice index alone; each rank places only what lies in its own box.
#pragma once

#include "sph/distribution.hpp"
#include "sph/particles.hpp"
#include "sph/physics.hpp"
#include "sph/scene.hpp"

namespace sph {

/// Fills `particles` (empty) with this rank's share. Throws InputError if nothing is placed anywhere.
void place_particles(const Scene& scene, const PositionScale& scale, const Distribution& distribution,
                     Particles& particles);

}  // namespace sph
