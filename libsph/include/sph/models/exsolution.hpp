// Water that leaves a melt slowly (group.exsolution_time): what is dissolved, w, is state, and follows what the pressure
// would have dissolved, at constant density and gas content m,
//   dw/dt = (min(m, m_d(p)) - w) / tau.
// Over a step w relaxes by the exponential of the rate that the equation has where it is: what comes out of solution
// raises the pressure, and with it m_d, so that rate is (1 - dm_d/dp dp/dw) / tau, and no step is too long. In groups
// without tau w is min(m, m_d) always.
#pragma once

#include "sph/models/builder.hpp"

namespace sph {

/// Some group has a tau.
[[nodiscard]] bool exsolves_slowly(const Scene& scene);

/// Once pressures are those of the densities.
void add_exsolution(Builder& builder);
/// At the start all is in equilibrium.
void start_exsolution(const SphConstants& constants, Particles& particles);

}  // namespace sph
