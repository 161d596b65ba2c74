// What a scene costs in memory and messages, from the field table, and what a run has cost.
#pragma once

#include <vector>

#include "sph/physics.hpp"
#include "sph/report.hpp"
#include "sph/simulation.hpp"

namespace sph {

[[nodiscard]] std::size_t bytes_of(FieldSet fields, int dim);

/// Fields that a halo particle needs at all: what passes read of neighbours.
[[nodiscard]] FieldSet halo_fields(const Physics& physics);

/// Fields sent before each pass in a step without a rebuild: what it reads and has changed since it was last
/// sent.
[[nodiscard]] std::vector<FieldSet> refreshes_of(const Physics& physics);

/// All but wall time, steps, names and imbalance. Collective.
[[nodiscard]] Performance performance_of(Simulation& simulation);

}  // namespace sph
