// Whether a scene's time step is one that the integrator bears.
#pragma once

#include "sph/scene.hpp"

namespace sph {

/// Throws InputError above the integrator's limits, naming the key: of c dt / h at the start, particles at
/// rest, and of diffusion and viscosities (physics/damping_limit.hpp).
void check_time_step(const Scene& scene);

}  // namespace sph
