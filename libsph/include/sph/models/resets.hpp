// Boxes in which particles get another state at the end of each step ([[reset]]): hot or gas-rich matter comes in where a
// period, or a flow, has brought old matter round. Of a particle in a box
//   the temperature becomes T, its enthalpy H(T), at constant mass;
//   the pressure p, at constant volume: mass comes in, of the matter that is there, or leaves;
//   the gas content m, its mass M (1 + m), M that of its liquid, at constant temperature, velocity and pressure: the
//   density follows, and the volume. What can be dissolved is, where that takes time. (At constant volume gas that comes in would be a blow.)
// What heat, gas and other mass that adds is counted for the particle (heat_inflow, gas_inflow, mass_inflow); its momentum grows as its mass does.
#pragma once

#include "sph/models/builder.hpp"

namespace sph {

/// Boxes with another gas content: particles count what they get.
[[nodiscard]] bool resets_gas(const Scene& scene);

/// After transitions, which are judged by what the step has made.
void add_resets(Builder& builder);

}  // namespace sph
