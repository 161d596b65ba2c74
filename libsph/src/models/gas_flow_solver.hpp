// Gas flow by the pressures of the end of the step, which limits no time step by stability:
//   (C - dt L) dp = dt (what flows by the pressures p of its start),   C = V / ((1 + m) / rho dp/dm),
// L with the conductances of the start. Contents then change by the fluxes of p + dp, pair by pair, not by C dp: gas is
// conserved to rounding whatever the tolerance.
#pragma once

#include "models/gas_outside.hpp"
#include "sph/models/builder.hpp"

namespace sph {

/// After the sums of the flow by the pressures of the start: Field::trial becomes p + dp.
void add_implicit_gas_pressures(Builder& builder, const GasOutside& outside);

}  // namespace sph
