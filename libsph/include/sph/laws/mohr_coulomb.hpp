// Mohr-Coulomb with tension cut-off (Coulomb 1773; return in principal stresses: Larsson & Runesson 1996, Clausen,
// Damkilde & Andersen 2006), s1 >= s2 >= s3, tension positive:
//   (s1 - s3) + (s1 + s3) sin(phi) <= 2 c cos(phi),   s1 <= min(T, c cos(phi)/sin(phi))
// Plastic strain: of shear along (1 + sin(psi), 0, -(1 - sin(psi))), psi the dilatancy, of tension along (1, 0, 0); on
// edges and tips along those of all planes that meet there, none of them negative (Koiter 1953). Linear planes and
// linear elasticity: each region is the solution of at most three linear equations, no iteration. What is returned
// lies on the surface to rounding of the trial stress, and returning it again changes nothing.
#pragma once

#include <array>
#include <cstdint>

#include "sph/laws/plasticity.hpp"

namespace sph {

/// Where on the surface a stress ends: planes of shear 13, 23, 12 and of tension 1, 2, 3.
enum class StressRegion : std::uint8_t {
  elastic,
  shear,          ///< s1 > s2 > s3
  edge_12,        ///< s1 = s2
  edge_23,        ///< s2 = s3
  tension,        ///< s1 = T
  tension_edge,   ///< s1 = s2 = T
  tension_tip,    ///< s1 = s2 = s3 = T
  shear_tension,  ///< s1 = T on the plane of shear
  tip_12,         ///< s1 = s2 = T there
  tip_23          ///< s1 = T, s2 = s3 there
};

struct StressReturn {
  std::array<double, 3> stress;  ///< [Pa]
  StressRegion region = StressRegion::elastic;
  double plastic_shear = 0;   ///< largest less smallest principal plastic strain
  double plastic_volume = 0;  ///< trace of the plastic strain, >= 0
  double opening = 0;         ///< that of the planes of tension alone
};

/// Of principal stresses, the largest first. What is not finite stays as it is.
[[nodiscard]] StressReturn return_to_mohr_coulomb(const StrengthConstants& constants,
                                                  const std::array<double, 3>& trial);

/// How far a sorted stress is beyond the surface, 0 or negative within [Pa].
[[nodiscard]] double beyond_mohr_coulomb(const StrengthConstants& constants,
                                         const std::array<double, 3>& stress);

}  // namespace sph
