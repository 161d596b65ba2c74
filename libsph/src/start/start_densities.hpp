// Densities and masses of a start that cannot be: suction beyond the bulk modulus of a material leaves it
// none, and rows may say anything.
#pragma once

#include "decomp/comm.hpp"
#include "sph/core/particles.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

/// Throws InputError on all ranks, naming the particle with the lowest id. Collective.
void check_start_densities(const decomp::Comm& comm, const Scene& scene, const Particles& particles);

}  // namespace sph
