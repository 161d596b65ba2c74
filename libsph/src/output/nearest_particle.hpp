// The particle nearest to a point: exact integer distances, the lowest id on ties, the same on all ranks.
#pragma once

#include "sph/step/simulation.hpp"

namespace sph {

/// Collective.
[[nodiscard]] std::uint64_t nearest_particle(const Simulation& simulation, const Double3& point);

}  // namespace sph
