// How long the lists of a state may still serve: bounds on how far particles have gone since they were made. No
// positions to remember, and never late.
#pragma once

#include <vector>

#include "decomp/timer.hpp"
#include "sph/core/findings.hpp"
#include "sph/plan/reduction.hpp"
#include "sph/step/state.hpp"

namespace sph {

class ListAge {
 public:
  explicit ListAge(const State& state) : state_(state), moved_(state.sets().size(), 0) {}

  /// Particles of a set may have gone as far as this [m].
  void add(std::size_t set, double way) { moved_[set] += way; }
  /// What no stage declares of the ways of a step in which no particle was faster than `speed`.
  void add_paths(double speed);
  /// Lists are new.
  void renew() { moved_.assign(moved_.size(), 0); }
  [[nodiscard]] double longest() const;  ///< way since then [m]

  /// Particles of this rank that have left the domain in this step.
  [[nodiscard]] Findings leavers(double speed) const;
  /// How far the next step looks back from where a particle is [m].
  [[nodiscard]] double look_back() const;

  /// Throws GuardError where the next step could go too far.
  void guard() const;
  /// Must the next step make lists anew? After the reduction of a step. Collective; throws GuardError as guard() does.
  [[nodiscard]] bool look(const Reduction& reduction, decomp::Timers& timers);

 private:
  const State& state_;
  std::vector<double> moved_;  ///< of each set: bound on any particle's path since the last rebuild [m]
};

}  // namespace sph
