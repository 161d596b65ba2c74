// How long the lists of a state may still serve: bounds on how far particles have gone, and neighbours apart, since
// they were made. Where the fastest particle of each step would have used up what lists reach beyond the range,
// pairs look how it is.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "decomp/timer.hpp"
#include "sph/core/findings.hpp"
#include "sph/plan/particle_set.hpp"
#include "sph/plan/reduction.hpp"
#include "sph/step/state.hpp"

namespace sph {

class ListAge {
 public:
  /// Both stay where they are.
  ListAge(const State& state, std::span<SetPair* const> pairs)
      : state_(state), pairs_(pairs), ways_(state.sets().size()) {}

  /// Particles of a set may have gone as far as this [m].
  void add(std::size_t set, double way) {
    ways_[set].alone += way;
    ways_[set].together += 2 * way;
  }
  /// What no stage declares of the ways of a step in which no particle was faster than `speed`.
  void add_paths(double speed);
  /// Lists are new.
  void renew() { ways_.assign(ways_.size(), {}); }
  [[nodiscard]] double longest() const;  ///< way of any particle since then [m]

  /// Particles of this rank that have left the domain in this step.
  [[nodiscard]] Findings leavers(double speed) const;
  /// How far the next step looks back from where a particle is [m].
  [[nodiscard]] double look_back() const;

  /// Throws GuardError where the next step could go too far.
  void guard() const;
  /// Must the next step make lists anew? After the reduction of a step, of the state's sets. Collective; throws GuardError
  /// as guard() does.
  [[nodiscard]] bool look(const Reduction& reduction, std::span<ParticleSet> sets, decomp::Timers& timers);

 private:
  /// Lists hold all pairs when ways are these.
  [[nodiscard]] bool serve(std::span<const SetPair::Ways> ways) const;
  /// Bounds when the next step has moved what it moves.
  [[nodiscard]] std::vector<SetPair::Ways> next() const;
  /// Looks at the ways of all pairs; those after the next drift, or nothing where some pairs rely on the bound.
  [[nodiscard]] std::optional<std::vector<SetPair::Ways>> measure(std::span<ParticleSet> sets,
                                                                  decomp::Timers& timers);

  const State& state_;
  std::span<SetPair* const> pairs_;
  std::vector<SetPair::Ways> ways_;  ///< of each set, bounds since the last rebuild
};

}  // namespace sph
