// What a step of melts works with: their fields over the patch of the grid, and what follows from these for the flow.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "sph/scene/scene.hpp"
#include "stokes/conduction.hpp"
#include "stokes/solver.hpp"
#include "stokes/transport.hpp"

namespace sph {

/// What grains make of a melt, over the patch of its grid; without grains nothing.
struct Suspended {
  stokes::Field solid;      ///< phi
  stokes::Field excess;     ///< of phi (rho_s - rho_f) [kg/m^3]
  stokes::Field stiffness;  ///< of the contacts, over a time a viscosity [Pa]
  stokes::Velocity force;   ///< on the mixture: excess weight and contacts [N/m^3]
  stokes::Velocity passed;  ///< grains, since the last flow, through faces, in volumes of cells
};

class MeltWork {
  const decomp::Comm* comm_;
  const Scene* scene_;
  std::array<std::size_t, 2> melts_;  ///< groups

 public:
  MeltWork(const decomp::Comm& comm, const Scene& scene, const std::vector<decomp::Box>& boxes);
  [[nodiscard]] const stokes::Patch& patch() const { return solver.patch(); }

  [[nodiscard]] stokes::Field densities() const;    ///< of the melt [kg/m^3]
  [[nodiscard]] stokes::Field viscosities() const;  ///< of the melt [Pa s]
  /// Grains make a melt thicker; a flow that serves for `dt` [s] meets their contacts, too.
  void thicken(stokes::Field& viscosities, double dt) const;
  /// On faces [N/m^3]; copies of the densities are up to date. Collective.
  [[nodiscard]] stokes::Velocity driving_force(const stokes::Field& densities) const;
  /// What a step of `dt` [s] brings back; copies of the composition are up to date.
  [[nodiscard]] stokes::Resistance stratification(double dt) const;

  stokes::Solver solver;
  stokes::Transport transport;
  std::optional<stokes::Conduction> conduction;
  stokes::Flow flow;
  stokes::Field temperature, composition, share;
  stokes::Field thick;  ///< viscosities of the last flow [Pa s]
  std::optional<Suspended> suspended;

 private:
  void take_off_layers(std::size_t axis, stokes::Field& force) const;
};

}  // namespace sph
