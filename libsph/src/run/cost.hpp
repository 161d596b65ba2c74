// What a scene costs in memory and messages, from the field table, and what a run has cost.
#pragma once

#include "sph/plan/plan.hpp"
#include "sph/run/report.hpp"
#include "sph/step/simulation.hpp"

namespace sph {

[[nodiscard]] std::size_t bytes_of(FieldSet fields, int dim);

/// Fields that a halo particle of a set needs at all: what stages read of neighbours. `fields`: those it has.
[[nodiscard]] FieldSet halo_fields(const Plan& plan, std::size_t set, FieldSet fields);

/// All but wall time, steps, names and imbalance. Collective.
[[nodiscard]] Performance performance_of(Simulation& simulation);

}  // namespace sph
