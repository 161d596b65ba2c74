// Runs the stages of a plan on the sets of a state: halos before boundaries, communication behind the interior.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "decomp/memory.hpp"
#include "decomp/timer.hpp"
#include "sph/core/findings.hpp"
#include "sph/models/parts.hpp"
#include "sph/plan/particle_set.hpp"
#include "sph/step/list_age.hpp"

namespace sph {

/// Accelerations that a caller adds to those of the scene: it sets those of the owned rows of all sets, [row][component] [m/s^2], 0 before.
/// `time` is that of positions; velocities are of half a step before. If each row's is a function of its own state and time, bits
/// depend on no ranks. It throws on all ranks or on none.
using Accelerate = std::function<void(double time, std::span<double> accelerations)>;

class PlanRunner {
 public:
  struct Counters {
    std::int64_t iterations = 0, solved = 0;  ///< of solvers, and how often they were asked
    std::int64_t repeats = 0;                 ///< of loops
  };

  PlanRunner(const decomp::Comm& comm, Parts& parts, std::vector<ParticleSet>& sets, ListAge& age,
             decomp::Timers& timers)
      : comm_(comm), parts_(parts), sets_(sets), age_(age), timers_(timers) {}

  void run(const std::vector<Entry>& entries, GlobalState& global);
  /// Before rows move: what sums over pairs have packed of them gives way to what sorting takes.
  void forget_rows() { decomp::release(rows_); }

  /// What a caller gives in the step at hand, if there is one. Rows stay where they are from there to the kick.
  void ask(const Accelerate& accelerate, double time);

  /// What stages get of a set, and of another one beside it.
  [[nodiscard]] StepState state_of(std::size_t set, GlobalState& global,
                                   std::optional<std::size_t> other = std::nullopt);

  /// Of this rank since forget_maxima().
  [[nodiscard]] const StepMaxima& maxima() const { return maxima_; }
  void forget_maxima() { maxima_ = {}; }
  [[nodiscard]] const Findings& findings() const { return findings_; }  ///< of this rank
  [[nodiscard]] const Counters& counters() const { return counters_; }

 private:
  void run(const Stage& stage, StepState& state);
  [[nodiscard]] bool improve(const Entry& loop, GlobalState& global);

  const decomp::Comm& comm_;
  Parts& parts_;
  std::vector<ParticleSet>& sets_;
  ListAge& age_;
  decomp::Timers& timers_;
  decomp::LargeVector<std::byte> rows_;
  std::vector<double> given_;  ///< accelerations of the sets' owned rows, or none
  Findings findings_;
  StepMaxima maxima_;
  Counters counters_;
};

}  // namespace sph
