// How large a step density diffusion and the explicit viscosities bear, by linear analysis on the lattice. A
// mode exp(i k.x) of density and velocity, advanced as the integrator does,
//     rho' = (1 - a) rho - s v,    v' = (1 - b) v + s rho',
// stays bounded if a < 2, b < 2 and s^2 < (2 - a)(2 - b), where for each k, V f = V W'/r of the neighbours x:
//     s   = c dt |D|,               D = sum V f x sin k.x                       pressure and divergence
//     a   = 2 delta h c dt L,       L = -sum V f (1 - cos k.x)                  density diffusion
//     b  <- 2 nu dt L / m2                                                      Laplacian viscosity
//           2 (D + 2) nu dt (n.Q.n) / m4,   Q = -sum V f x x (1 - cos k.x)      symmetric viscosity
//           alpha h c dt / 2 (n.A.n),  A = Q with weights 1 / (r^2 + 0.01 h^2)  artificial: half of the pairs
//           zeta / rho dt (n.D)^2                                               bulk viscosity
// approach, n the direction of v. Measured on a jittered flow (h = 1.2 dx, c dt/h 0.2 to 1.1) runs blow up at
// 0.85 to 0.9 of these limits, of bulk viscosity at 0.75: neighbours that have come close count for more. The
// rates are multiplied by that.
#pragma once

#include <string>
#include <vector>

#include "sph/scene/scene.hpp"

namespace sph {

struct DampingLimit {
  double step;         ///< largest stable time step [s]
  std::string key;     ///< of the value that limits it most ...
  double value, most;  ///< ... which could be so large at the present step, 0 if that is too long anyway
};

/// `sounds`: the fastest of each group (start/start_sounds.hpp); `step`: the present one [s]. No limit for grains and total-Lagrangian solids, which have none of these.
[[nodiscard]] DampingLimit damping_limit(const Scene& scene, const std::vector<double>& sounds, double step);

}  // namespace sph
