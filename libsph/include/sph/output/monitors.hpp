// What a scene's monitors say at one moment: the columns of series.csv. Sums are exact and a particle's
// values come from its owner, so every number has the same bits on any number of ranks.
//   particle  x, y(, z), vx, vy(, vz), then rho, p(, psi)(, u)(, T), or of a grain that spins wx, wy, wz [rad/s]
//   group     n, then the same as means weighted by mass: sum(m a) / sum(m), each product rounded once; over
//             the particles that belong to the group now. nan while it is empty. Fragments belong to the
//             group they joined, so the cylinder and its spray are two groups
//   energy    kinetic  sum m v^2/2;  potential  sum -m g.x;  elastic  compression of groups with the linear
//             law, m K/rho_0 (ln(rho/rho_0) + rho_0/rho - 1), which is -int p dV, and V S:S/(4 mu) of the
//             deviator S of solids (conservative formulation). Walls and bubbly groups do not enter the last.
//             With ideal gases internal, sum m u, before the last; with heat sum m H
//             With strength plastic, the work of stress on plastic strain since the start
//             Of grains: kinetic, rotational  sum m r^2 w^2/5, potential, elastic  the springs of all
//             contacts that overlap now, with walls and fixed grains too (formulas: contact_records.hpp)
//   momentum  px, py(, pz)  sum m v
//   budget    mass;  heat  sum m H, and heat_in, what came from walls since the start: with heat;
//             gas  sum M m, and gas_in, what came from walls less what escaped: where gas flows
//   wall      x, y, z, vx, vy, vz, fx, fy, fz: the plane's point now, its velocity, and the force of the
//             grains on it in the last step [N]
//   body      of a rigid one: x, y, vx, vy, angle [rad], w, fx, fy, torque; in 3D x, y, z, vx, vy, vz, qw, qx, qy, qz,
//             wx, wy, wz, fx, fy, fz, tx, ty, tz: its centre of mass, how it is turned (a unit quaternion), and the force
//             of the last step, gravity left out, with its torque about the centre
//   contacts  n  contacts between grains, each once;  walls  those of a grain with a wall or a fixed grain;
//             z  mean coordination, (2 n + walls) / number of grains
//   gauge     v.., rho, p and what else particles have, where it is, and cover (output/gauge.hpp); of a line 1_vx, ..
//   level     h, of the surface above its point [m]
//   flux      mass_rate, volume_rate: what passes a rectangle (output/flux.hpp)
// Positions [m] are those within the periodic domain; p is the pressure above the surface pressure [Pa].
// Walls and fixed grains are left out of energy, momentum and the number of grains.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "decomp/exact_sum.hpp"
#include "sph/step/simulation.hpp"

namespace sph {

class Monitors {
 public:
  /// Chooses the particle of each particle monitor: the one nearest to its point, lowest id on ties; or the one that is
  /// known from before, by number of such monitors, which may be gone. Collective. Throws InputError if a scene's id does
  /// not exist.
  explicit Monitors(const Simulation& simulation,
                    const std::vector<std::optional<std::uint64_t>>& known = {});

  [[nodiscard]] const std::vector<std::uint64_t>& ids() const { return ids_; }
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  [[nodiscard]] const std::vector<std::string>& units() const { return units_; }  ///< "" of numbers
  /// Collective; refreshes halo copies, and rebuilds lists, where contacts are asked for.
  [[nodiscard]] std::vector<double> values(Simulation& simulation) const;

 private:
  void make_names(const Simulation& simulation);

  std::vector<std::uint64_t> ids_;
  std::vector<std::string> names_, units_;
};

/// Kinetic energy of all movers [J]. Collective.
[[nodiscard]] double kinetic_energy(const Simulation& simulation);

}  // namespace sph
