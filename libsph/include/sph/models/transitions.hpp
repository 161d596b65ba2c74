// Matter that turns into another (Ida, 4.3; [[group.becomes]]): a particle joins the group of the first row of its table
// whose condition has held for as long as that asks, of values of now or of running means (Ida, 5: against noise), which
// are state and begin anew in another group. It keeps
//   mass, momentum, volatiles, enthalpy, pressure,
// so that where the equation of state is another its density follows, its volume and its temperature. A fluid has no
// stress but its pressure: the elastic energy that a solid loses with its deviator is counted for the particle.
#pragma once

#include "sph/models/builder.hpp"

namespace sph {

/// Some group has a table.
[[nodiscard]] bool has_transitions(const Scene& scene);
/// ... that changes what is elastic.
[[nodiscard]] bool has_released_energy(const Scene& scene);

/// Once pressures, gas and temperatures are those of the step.
void add_transitions(Builder& builder);

}  // namespace sph
