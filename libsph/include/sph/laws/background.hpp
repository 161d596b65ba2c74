// Pressures where a background of density rho_b bears the weight that is taken from all matter (Domain::background).
// Particles have the excess over
//   p_b = p_surface + rho_b g.(x - x_s).
// Gas is as dense as all of the pressure makes it, and weighs g (rho - rho_b). Liquids and solids see the excess alone:
// density and bulk modulus of their groups are those in place, and they weigh g rho (1 - rho_b / rho_0). So what is as
// heavy as the background is at rest exactly, and sound need not be fast against sqrt(g H): with g (rho - rho_b) what
// the excess compresses of rho_b too would be weight, and that is small only where c^2 is far above g H.
#pragma once

#include <cmath>

#include "sph/laws/eos/law.hpp"

namespace sph {

/// rho_b g.(x - x_s); 0 without background [Pa].
[[nodiscard]] inline double background_pressure(const Domain& domain, const Double3& x) {
  if (domain.background.density == 0) return 0;
  double along = 0, square = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    along += domain.gravity[a] * x[a];
    square += domain.gravity[a] * domain.gravity[a];
  }
  return domain.background.density * (along + std::sqrt(square) * domain.background.surface);
}

/// What the equation of state of this group sees besides the pressure of a particle at x [Pa].
[[nodiscard]] inline double outer_pressure(const Scene& scene, const Group& group, const Double3& x) {
  const Domain& domain = scene.domain;
  if (domain.background.density == 0) return domain.surface_pressure;
  return group.eos.law->kind == EosKind::bubbly ? domain.surface_pressure + background_pressure(domain, x)
                                                : 0.0;
}

/// What gravity acts on of a mass of this group that has this density.
[[nodiscard]] inline double weight_share(const Scene& scene, const Group& group, double density) {
  const bool bubbly = group.eos.law->kind == EosKind::bubbly;
  return 1 - scene.domain.background.density / (bubbly ? density : group.density);
}

}  // namespace sph
