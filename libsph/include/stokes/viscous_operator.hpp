// A u = -div 2 eta eps(u) + c u on a patch, second order: normal stresses at cell centres, shear stresses at edges,
//   tau_aa = 2 eta_c d_a u_a,   tau_ab = eta_e (d_b u_a + d_a u_b),
// and at faces a resistance c, where there is one: what rises into lighter fluid in a step comes back.
#pragma once

#include <array>

#include "stokes/grid.hpp"

namespace stokes {

/// Of the components that faces resist, c [Pa s/m^2].
struct Resistance {
  std::array<bool, 3> along{};  ///< the same on all ranks, those without cells too
  Velocity faces;
};

/// What resists on a patch: viscosities of its cells, and of the edges of each pair of axes (0 1, 0 2, 1 2) [Pa s].
struct Viscosity {
  explicit Viscosity(const Patch& p);
  Field cells;
  std::array<Field, 3> edges;
  Resistance resistance;
};
/// Which edges are those of axes a and b.
[[nodiscard]] constexpr std::size_t pair_of(int a, int b) { return static_cast<std::size_t>(a + b - 1); }

/// How the viscosity of an edge follows from those of the four cells around it.
enum class EdgeMean : std::uint8_t { arithmetic, harmonic };
/// Edges from cells, whose copies are up to date.
void set_edges(const Patch& patch, EdgeMean mean, Viscosity& viscosity);

/// y = A u in the rank's cells, 0 on faces that are walls; copies of u are up to date.
void apply(const Patch& patch, const Viscosity& viscosity, const Velocity& u, Velocity& y);
/// One over its diagonal, 0 on faces that are walls.
[[nodiscard]] Velocity inverse_diagonal(const Patch& patch, const Viscosity& viscosity);
/// y += grad p; y is 0 on faces that are walls.
void add_gradient(const Patch& patch, const Field& p, double factor, Velocity& y);
/// -div u.
void minus_divergence(const Patch& patch, const Velocity& u, Field& y);

}  // namespace stokes
