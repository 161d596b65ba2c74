// Whether a scene's time step is one that the integrator bears.
#pragma once

#include <vector>

#include "sph/models/sph_time_step.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

/// Throws InputError above the integrator's limits, naming the key: of c dt / h at the start, particles at
/// rest, and of diffusion and viscosities (models/damping_limit.hpp). Before there are particles: not where pressure
/// makes matter stiffer.
void check_time_step(const Scene& scene);
/// The same of fluids and solids, c of each group being that of the start (start/start_sounds.hpp).
void check_time_step(const Scene& scene, const SphTimeStep& steps, const std::vector<double>& sounds);

}  // namespace sph
