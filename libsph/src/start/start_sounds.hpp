// How fast sound is at most in each material as a start has it: as at rest, sqrt(K / rho_0) and that of p-waves in a
// solid, or faster where pressure has made the matter stiffer. The limits of the time step, the step that `check`
// foretells and the number of Courant on the screen all take it from here.
#pragma once

#include <vector>

#include "decomp/comm.hpp"
#include "sph/core/particles.hpp"
#include "sph/scene/scene.hpp"
#include "start/start_count.hpp"

namespace sph {

/// Of each group at rho_0 [m/s].
[[nodiscard]] std::vector<double> sounds_at_rest(const Scene& scene);

/// Of the particles as they are, before they have pressures: of each group, at least that at rest. Collective.
[[nodiscard]] std::vector<double> fastest_sounds(const decomp::Comm& comm, const Scene& scene,
                                                 const Particles& particles);

/// The same of a lattice that is too large to be placed, from where its groups are (but for its jitter); that at rest
/// where that is not known.
[[nodiscard]] std::vector<double> fastest_sounds(const Scene& scene, const std::vector<Height>& heights);

/// A rigid body in a fluid that can touch nothing: no sound of it limits the time step.
[[nodiscard]] bool is_quiet(const Scene& scene, const Group& group);

/// True where the sound of a group depends on its density.
[[nodiscard]] bool stiffens(const Group& group);

}  // namespace sph
