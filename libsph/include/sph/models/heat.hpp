// Heat of fluids and solids: the enthalpy of a particle is state, conducted pair by pair (terms/conduction.hpp), its
// temperature what that and the group say (laws/enthalpy.hpp). What walls and friction (terms/viscous_heat.hpp) give is
// counted for each particle, so that
//   sum m H - sum (heat from walls and friction) = what it was at the start,
// but for rounding, on any number of ranks. Heat that flowing gas brings is in gas_flow.hpp. Explicit: dt <= 0.25 h^2
// rho c / k, with the density of now where gas makes it low; implicit: src/models/conduction_solver.hpp.
#pragma once

#include <vector>

#include "sph/models/builder.hpp"
#include "sph/models/model.hpp"

namespace sph {

/// Of explicit conduction, 0 if there is none [s]; a pure function of the scene.
[[nodiscard]] double longest_heat_step(const Scene& scene);
/// Some walls keep a temperature or give a flux.
[[nodiscard]] bool has_warm_walls(const Scene& scene);

class Heat final : public Model {
 public:
  Heat(std::size_t set, const SphConstants& constants);

  /// Its fields and stages; where walls are warm, after the wall slopes.
  void add_to(Builder& builder) const;

  void reserve(Reduction& reduction) override;
  [[nodiscard]] double start(const decomp::Comm& comm, Particles& particles, GlobalState& global) override;
  [[nodiscard]] bool report(const StepState& state, Reduction& reduction) override;
  [[nodiscard]] double longest_step(const Reduction& reduction) const override;
  void guard_step(const Reduction& reduction, const GlobalState& global) const override;
  [[nodiscard]] std::vector<Energy> energies() const override { return {Energy::internal}; }
  void add_energies(const Particles& particles, EnergySums& sums) const override;

 private:
  [[nodiscard]] double fastest(const Particles& particles) const;
  [[nodiscard]] double limit(double diffusivity) const;

  const SphConstants* constants_;
  std::vector<double> of_bubbly_;  ///< by group: the largest k / c beside others, 0 unless bubbly [kg/m/s]
  bool bubbly_;                    ///< there is such a group
  Reduction::Maximum diffusivity_{};
};

}  // namespace sph
