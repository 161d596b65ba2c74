// The start from a file. Every rank reads a slice of its rows (start_rows.hpp), checks it and sends each
// particle to its owner.
#pragma once

#include "sph/core/particles.hpp"
#include "sph/plan/distribution.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

/// Fills `particles` (empty) with this rank's share. Throws InputError "file: row: what" on all ranks.
void place_particles_from_file(const Scene& scene, const PositionScale& scale, Distribution& distribution,
                               Particles& particles);

}  // namespace sph
