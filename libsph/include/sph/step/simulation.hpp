// A running scene on all ranks: a state, and the step that ties particles, models, lists and distribution
// together. The step is the one screen to read first (simulation.cpp).
#pragma once

#include <span>
#include <vector>

#include "decomp/comm.hpp"
#include "decomp/timer.hpp"
#include "sph/checkpoint/checkpoint.hpp"
#include "sph/step/list_age.hpp"
#include "sph/step/plan_runner.hpp"
#include "sph/step/state.hpp"

namespace sph {

/// Throws InputError where nothing has inertia, which an Accelerate needs.
void refuse_stillness(const Scene& scene);

class Simulation : public State {
 public:
  /// From the scene's start. Collective, like every member that is not a plain accessor.
  Simulation(const decomp::Comm& comm, const Scene& scene);
  /// From a checkpoint, on any number of ranks.
  Simulation(const decomp::Comm& comm, const Scene& scene, const CheckpointHandle& checkpoint);

  /// One time step. `request` (any integer, the caller's) travels with the step's reduction: the largest over
  /// all ranks is returned, one step late by construction. `accelerate` is no state: checkpoints do not hold it.
  std::int64_t step(std::int64_t request = 0, const Accelerate& accelerate = {});
  /// Between steps: the grains `gone` leave, by their ids ascending, then others come in this order. The same on all ranks; budgets count them.
  /// Throws InputError, the state being as it was, where they do not fit or the scene is not open.
  void exchange_grains(std::span<const std::uint64_t> gone, std::span<const GivenGrain> come);

  /// Brings the halo copies of these fields up to date, for output that looks at neighbours.
  void refresh_halo(FieldSet fields, std::size_t set = 0) { sets_[set].refresh(fields, timers_); }
  /// The same for contacts: all that are there now are in the lists, and halo copies are where their owners
  /// are. Rebuilds early what the next step would rebuild first.
  void refresh_contacts();
  /// Gives back, before files take memory, what only the step needed.
  void make_room() { runner_.forget_rows(); }

  [[nodiscard]] decomp::Timers& timers() { return timers_; }
  [[nodiscard]] std::int64_t rebuilds() const { return rebuilds_; }
  [[nodiscard]] const PlanRunner::Counters& counters() const { return runner_.counters(); }

 private:
  /// Common end of both constructors. `again`: what a state that is gone on from shows, which stays as it is; with other
  /// laws that of walls.
  void begin(const FieldSet* again, bool other_laws);
  void derive();  ///< what follows from the state of a particle alone
  void scatter();
  void settle();
  void approach(Settling& settling, std::size_t set);
  void kick_half_a_step(const Accelerate& accelerate);
  void rebuild();
  [[nodiscard]] ListSetting list_setting(const SetPair& pair);
  void reduce(std::int64_t request, bool left);
  std::int64_t finish_step(std::int64_t request);

  decomp::Timers timers_;
  ListAge age_{*this, parts_.pairs};
  PlanRunner runner_{comm_, parts_, sets_, age_, timers_};
  decomp::Payload arrived_;  ///< contacts read from a checkpoint, until the first lists are there
  bool stale_ = true;        ///< lists must be made anew before they are looked at
  std::int64_t rebuilds_ = 0;
  bool rows_changed_ = false;  ///< lists are not of the rows that there are
};

}  // namespace sph
