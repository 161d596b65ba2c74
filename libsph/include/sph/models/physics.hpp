// A scene of fluids and solids: the models it is made of, its time step, and what it says at the end of a
// step. Nothing here knows about ranks.
#pragma once

#include <optional>
#include <vector>

#include "sph/models/gas.hpp"
#include "sph/models/model.hpp"
#include "sph/models/shifting.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

/// Largest c dt / h of a run, c the fastest sound: beyond it the integrator is unstable.
[[nodiscard]] inline double courant_limit(const Scene& scene) {
  return scene.total_lagrangian() ? 1.0 : 1.2;  // contacts and the stiffest allowed hourglass control
}
/// What is recommended, and the default of time.cfl.
inline constexpr double courant_recommended = 0.8;

class Physics final : public Model {
 public:
  Physics(std::size_t set, const Scene& scene, const PositionScale& scale);
  Physics(const Physics&) = delete;  // its stages hold on to it
  Physics& operator=(const Physics&) = delete;

  void reserve(Reduction& reduction) override;
  [[nodiscard]] double start(const decomp::Comm& comm, Particles& particles, GlobalState& global) override;
  void derive(Particles& particles) const override { derive(particles, 0, particles.owned()); }
  [[nodiscard]] bool report(const StepState& state, Reduction& reduction) override;
  void act(const Reduction& reduction, GlobalState& global) override;
  [[nodiscard]] double longest_step(const Reduction& reduction) const override;
  void guard_step(const Reduction& reduction, const GlobalState& global) const override;
  [[nodiscard]] double longest_look_back(const GlobalState& global) const override;
  [[nodiscard]] double growth(const Reduction& reduction) const override { return reduction[growth_]; }
  [[nodiscard]] double speed_limit() const override;

  [[nodiscard]] FieldSet fields() const { return builder_.fields(); }
  [[nodiscard]] const Plan& plan() const { return builder_.plan(); }
  /// Entries of its sums that come before the densities.
  [[nodiscard]] std::ptrdiff_t before_densities() const { return before_densities_; }
  [[nodiscard]] const SphConstants& constants() const { return constants_; }

  /// Pressure and what else follows from the state of a particle alone.
  void derive(Particles& particles, std::size_t first, std::size_t last) const {
    materials_.derive(ViewOf<Materials>(particles), first, last);
  }
  /// How far the partners of each row may be before the next rebuild, in metres, the ways of the particles
  /// left aside; empty where that is the same for all.
  [[nodiscard]] const std::vector<double>& find_reaches(const Particles& particles);

  /// Largest step the integrator takes [s], from the maxima of the step before.
  [[nodiscard]] double time_step(const StepMaxima& maxima) const;
  [[nodiscard]] double longest_shift(const GlobalState& global) const {
    return shifting_ ? shifting_->longest(global) : 0.0;
  }
  /// The same where nothing moves, and `sounds` are the fastest of each group (start/start_sounds.hpp).
  [[nodiscard]] double resting_step(const std::vector<double>& sounds) const;
  /// c dt / h of the fastest of them: what `check` warns about above 0.8 and refuses above the limit.
  [[nodiscard]] double courant_number(double dt, const std::vector<double>& sounds) const;
  [[nodiscard]] bool is_wall(std::uint32_t group) const { return constants_.is_wall(group); }

 private:
  [[nodiscard]] StepMaxima maxima_at_start(Particles& particles) const;
  void find_common_motion(const decomp::Comm& comm, Particles& particles, GlobalState& global) const;
  void add_liquids_and_solids();
  void add_end_of_step();

  const Scene* scene_;
  bool gas_;  ///< there is an ideal gas
  std::ptrdiff_t before_densities_ = 0;
  bool stiffens_ = false;  ///< some sound speed grows with the pressure
  SphConstants constants_;
  Materials materials_;
  BodyForces body_forces_;
  Builder builder_;
  std::optional<Shifting> shifting_;
  std::optional<GasReach> reach_;
  std::vector<double> no_reaches_;
  Reduction::Maximum sound_, viscosity_, growth_, unlike_;
  Reduction::Sums motion_, volume_;  ///< none where particles are not shifted
};

}  // namespace sph
