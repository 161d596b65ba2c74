// How long the time steps of fluids and solids may be: sound, flow, viscosity, capillary waves and accelerations pass at
// most a part of a smoothing length in one.
#pragma once

#include <vector>

#include "sph/laws/eos/law.hpp"
#include "sph/models/sph_constants.hpp"

namespace sph {

/// Largest c dt / h of a run, c the fastest sound: beyond it the integrator is unstable.
[[nodiscard]] inline double courant_limit(const Scene& scene) {
  return scene.total_lagrangian() ? 1.0 : 1.2;  // contacts and the stiffest allowed hourglass control
}
/// What is recommended, and the default of time.cfl.
inline constexpr double courant_recommended = 0.8;

/// The group's eta / rho and zeta / rho are those of its particles, not of the scene.
[[nodiscard]] inline bool viscosity_follows(const Group& g) {
  return g.viscosity_law.varies() || g.eos.law->kind == EosKind::bubbly;
}

class SphTimeStep {
 public:
  explicit SphTimeStep(const SphConstants& constants);

  /// Largest step the integrator takes [s], from the maxima of the step before.
  [[nodiscard]] double longest(const StepMaxima& maxima) const;
  /// The same where nothing moves, and `sounds` are the fastest of each group (start/start_sounds.hpp).
  [[nodiscard]] double resting(const std::vector<double>& sounds) const;
  /// c dt / h of the fastest of them: what `check` warns about above 0.8 and refuses above the limit.
  [[nodiscard]] double courant_number(double dt, const std::vector<double>& sounds) const;
  /// Throws GuardError where a fixed step is too long for the fastest sound.
  void guard(double sound, const GlobalState& global) const;
  /// ... or for the largest eta / rho and zeta / rho, where they are not what they were at the start.
  void guard_viscosity(double viscosity, double bulk, const GlobalState& global) const;

 private:
  const SphConstants* constants_;
  bool gas_;      ///< there is an ideal gas: its sound of now counts, with its flow
  bool follows_;  ///< viscosity or density of some fluid are not what they were: those of now count
};

}  // namespace sph
