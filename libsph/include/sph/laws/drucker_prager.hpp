// Drucker-Prager, the smooth cone (Drucker & Prager 1952), I1 the trace, J2 = s:s/2 of the deviator, tension positive:
//   sqrt(J2) + a I1 <= k,   I1/3 <= min(T, k/3a)
// with a, k that give the strength of Mohr-Coulomb in triaxial compression, a = 2 sin(phi) / sqrt(3) (3 - sin(phi)),
// k = 6 c cos(phi) / sqrt(3) (3 - sin(phi)), or, in the plane, in plane strain: a = tan(phi) / n, k = 3 c / n,
// n = sqrt(9 + 12 tan(phi)^2) (Chen & Mizuno 1990). Plastic strain likewise with the dilatancy instead of phi. The
// deviator keeps its direction: it is scaled, and the mean stress moves.
#pragma once

#include "sph/laws/plasticity.hpp"

namespace sph {

/// a, k, and a of the plastic strain.
struct DruckerPragerCone {
  double slope, limit, flow_slope;
};
[[nodiscard]] DruckerPragerCone drucker_prager_cone(const StrengthConstants& constants);

struct ConeReturn {
  double shear, mean;         ///< sqrt(J2), I1/3 [Pa]
  double plastic_shear = 0;   ///< 2 sqrt(J2) of the plastic strain: gamma in simple shear
  double plastic_volume = 0;  ///< its trace, >= 0
  double opening = 0;         ///< that of the cap alone
};

/// Of sqrt(J2) and I1/3. What is not finite stays as it is.
[[nodiscard]] ConeReturn return_to_drucker_prager(const StrengthConstants& constants, double shear,
                                                  double mean);

}  // namespace sph
