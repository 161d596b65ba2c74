// Whether a scene's time step is one that the integrator bears.
#pragma once

#include "sph/scene.hpp"

namespace sph {

/// c dt / h at the start of a run, particles at rest.
[[nodiscard]] double courant_number_of(const Scene& scene);

/// Throws InputError above the integrator's limit, naming the key.
void check_time_step(const Scene& scene);

}  // namespace sph
