// Conduction with the temperatures of the end of the step, which limits no time step:
//   m (H(T) - H_n) = dt (sum_j K_ij (T_j - T_i) + q - w (T_i - T_n,i)),
// q what walls and friction give at T_n, w how much less walls give a warmer particle. Newton's method, because of the
// latent heat in H(T) (laws/enthalpy.hpp): enthalpies are changed by m dH/dT times what conjugate gradients find for T,
// temperatures follow (Swaminathan & Voller 1992). Particles gain by the fluxes between the last temperatures: heat
// is conserved to rounding whatever the tolerance.
#pragma once

#include <memory>

#include "sph/models/builder.hpp"

namespace sph {

/// After what walls and friction give.
void add_implicit_conduction(Builder& builder);

}  // namespace sph
