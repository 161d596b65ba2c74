// What a scene's monitors say at one moment: the columns of series.csv. Sums are exact and a particle's
// values come from its owner, so every number has the same bits on any number of ranks.
//   particle  x, y(, z), vx, vy(, vz), rho, p(, psi)
//   group     n, then the same as means weighted by mass: sum(m a) / sum(m), each product rounded once; over
//             the particles that belong to the group now. nan while it is empty. Fragments belong to the
//             group they joined, so the cylinder and its spray are two groups
//   energy    kinetic  sum m v^2/2;  potential  sum -m g.x;  elastic  compression of groups with the linear
//             law, m K/rho_0 (ln(rho/rho_0) + rho_0/rho - 1), which is -int p dV, and V S:S/(4 mu) of the
//             deviator S of solids (conservative formulation). Walls and bubbly groups do not enter the last
//   momentum  px, py(, pz)  sum m v
// Positions [m] are those within the periodic domain; p is the pressure above the surface pressure [Pa],
// walls are left out of energy and momentum.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "decomp/exact_sum.hpp"
#include "sph/simulation.hpp"

namespace sph {

class Monitors {
 public:
  /// Chooses the particle of each particle monitor: the one nearest to its point, lowest id on ties.
  /// Collective. Throws InputError if a scene's id does not exist.
  explicit Monitors(const Simulation& simulation);
  /// Goes on with particles chosen before, one for each particle monitor of the scene.
  Monitors(const Simulation& simulation, std::vector<std::uint64_t> ids);

  [[nodiscard]] const std::vector<std::uint64_t>& ids() const { return ids_; }
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  [[nodiscard]] std::vector<double> values(const Simulation& simulation) const;  ///< collective

 private:
  void make_names(const Simulation& simulation);

  std::vector<std::uint64_t> ids_;
  std::vector<std::string> names_;
};

/// Kinetic energy of all movers [J]. Collective.
[[nodiscard]] double kinetic_energy(const Simulation& simulation);

}  // namespace sph
