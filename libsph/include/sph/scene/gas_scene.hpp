// What a scene of ideal gases says beyond what every scene says.
#pragma once

namespace sph {

/// Of a group with eos = "ideal_gas".
struct GasMaterial {
  double heat_ratio = 0;      ///< gamma [1]
  double start_pressure = 0;  ///< at rho_0; K = gamma p_0 [Pa]
  friend bool operator==(const GasMaterial&, const GasMaterial&) = default;
};

/// What makes shocks, and jumps of the start, as wide as the kernel.
struct GasTerms {
  double quadratic_viscosity = 0;  ///< beta, against strong shocks
  double conduction = 0;           ///< alpha_u
  friend bool operator==(const GasTerms&, const GasTerms&) = default;
};

}  // namespace sph
