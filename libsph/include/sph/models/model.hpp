// What a scene is made of. A model adds stages to the plan of a step and takes part in the end of a step,
// where all ranks learn what one of them has found. Models know nothing of ranks and nothing of each other.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "decomp/comm.hpp"
#include "sph/core/particles.hpp"
#include "sph/models/energies.hpp"
#include "sph/plan/distribution.hpp"
#include "sph/plan/particle_set.hpp"
#include "sph/plan/plan.hpp"
#include "sph/plan/reduction.hpp"

namespace sph {

class Model {
 public:
  static constexpr double any_step = std::numeric_limits<double>::infinity();

  explicit Model(std::size_t set) : set_(set) {}
  virtual ~Model() = default;

  /// Index of the set of particles that it is about: states and particles below are of that set.
  [[nodiscard]] std::size_t set() const { return set_; }
  /// Takes its places in the reduction.
  virtual void reserve(Reduction&) {}

  // At the start, in this order. Collective; throw InputError.
  /// Of particles that are not yet on their ranks: what the global record begins with. Returns how long the
  /// first step may be [s].
  [[nodiscard]] virtual double start(const decomp::Comm&, Particles&, GlobalState&) { return any_step; }
  /// What follows from the state of a particle alone: here, and when a run is resumed.
  virtual void derive(Particles&) const {}
  /// With lists and halo.
  virtual void check_start(const decomp::Comm&, const StepState&) const {}

  // At the end of a step, in this order.
  /// This rank's part of the reduction; false if something of it is not finite.
  [[nodiscard]] virtual bool report(const StepState&, Reduction&) = 0;
  /// Throws GuardError, on all ranks alike. Collective where the reduction says so.
  virtual void guard(const decomp::Comm&, const StepState&, const Reduction&) const {}
  /// What the reduction changes in the state, with the clock as it was in the step.
  virtual void act(const Reduction&, GlobalState&) {}
  /// What of its particles follows from that: sets these fields of them.
  [[nodiscard]] virtual FieldSet follow(Particles&, const GlobalState&) const { return {}; }
  /// How long the step to come may be [s].
  [[nodiscard]] virtual double longest_step(const Reduction&) const { return any_step; }
  /// Throws GuardError where that cannot be stable.
  virtual void guard_step(const Reduction&, const GlobalState&) const {}

  /// Particles come and go: takes out the rows of those that are gone, adds those of the new ones, and says so in the
  /// census; new lists are made at once. Returns how far from the place of its row a new particle may be [m], nothing where
  /// none came or went. Collective; the reduction says whether any did, on all ranks alike.
  [[nodiscard]] virtual std::optional<double> turn_over(const Distribution&, const Reduction&, ParticleSet&,
                                                        GlobalState&) {
    return std::nullopt;
  }

  /// Bound on any particle's path in the step at hand beyond what its stages declare, where none was faster
  /// than `speed` [m].
  [[nodiscard]] virtual double path(const GlobalState&, double /*speed*/) const { return 0; }
  /// How far from where a particle is a stage of the next step takes it to be [m].
  [[nodiscard]] virtual double longest_look_back(const GlobalState&) const { return 0; }
  /// How much of what lists bear particles' reach will have grown at the end of the next step; above 1 they
  /// must be made anew.
  [[nodiscard]] virtual double growth(const Reduction&) const { return 0; }
  /// Faster than that nothing moves that the scene could mean [m/s].
  [[nodiscard]] virtual double speed_limit() const { return std::numeric_limits<double>::infinity(); }

  /// What it counts of a scene's energies, ascending.
  [[nodiscard]] virtual std::vector<Energy> energies() const { return {}; }
  /// Of this rank's particles.
  virtual void add_energies(const Particles&, EnergySums&) const {}

 private:
  std::size_t set_;
};

}  // namespace sph
