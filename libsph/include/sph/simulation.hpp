// A running scene on all ranks: particles, physics, distribution, lists, and the step that ties them
// together. The step is the one screen to read first (simulation.cpp).
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "decomp/comm.hpp"
#include "decomp/timer.hpp"
#include "sph/checkpoint.hpp"
#include "sph/distribution.hpp"
#include "sph/fingerprint.hpp"
#include "sph/particle_set.hpp"
#include "sph/parts.hpp"
#include "sph/scene.hpp"

namespace sph {

class Simulation {
 public:
  /// From the scene's start. Collective, like every member that is not a plain accessor.
  Simulation(const decomp::Comm& comm, const Scene& scene);
  /// From a checkpoint, on any number of ranks.
  Simulation(const decomp::Comm& comm, const Scene& scene, const CheckpointHandle& checkpoint);

  Simulation(const Simulation&) = delete;  // its models stay where they are
  Simulation& operator=(const Simulation&) = delete;

  /// One time step. `request` (any integer, the caller's) travels with the step's reduction: the largest over
  /// all ranks is returned, one step late by construction.
  std::int64_t step(std::int64_t request = 0);

  /// Brings the halo copies of these fields up to date, for output that looks at neighbours.
  void refresh_halo(FieldSet fields, std::size_t set = 0) { sets_[set].refresh(fields, timers_); }
  /// The same for contacts: all that are there now are in the lists, and halo copies are where their owners
  /// are. Rebuilds early what the next step would rebuild first.
  void refresh_contacts();

  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] const decomp::Comm& comm() const { return comm_; }
  [[nodiscard]] const Particles& particles(std::size_t set) const { return sets_[set].particles; }
  /// Of all sets, as files have them. Of several sets it is a copy, without halo, good until the next step.
  [[nodiscard]] const Particles& particles() const;
  [[nodiscard]] std::span<const ParticleSet> sets() const { return sets_; }
  [[nodiscard]] const GlobalState& global() const { return global_; }
  [[nodiscard]] const PositionScale& scale() const { return scale_; }
  [[nodiscard]] const Wrap& wrap() const { return wrap_; }
  [[nodiscard]] const Physics* physics() const { return parts_.physics ? &*parts_.physics : nullptr; }
  [[nodiscard]] const Distribution& distribution() const { return distribution_; }
  [[nodiscard]] const NeighbourLists& lists() const { return parts_.sph_pairs->lists(); }
  [[nodiscard]] const Grains* grains() const { return parts_.grains ? &*parts_.grains : nullptr; }
  [[nodiscard]] bool has_history() const { return grains() != nullptr && grains()->lists().history() > 0; }
  /// Histories of this rank's contacts, one entry per contact of a row of particles(): what is checkpointed.
  [[nodiscard]] decomp::Payload contacts() const;
  [[nodiscard]] decomp::Timers& timers() { return timers_; }
  /// Of a simulation that has made no step since its checkpoint: computes what a snapshot holds besides the
  /// state, the pressure on walls. Changes no bit of the state. Collective.
  void derive_for_output();
  [[nodiscard]] std::string fingerprint() const;
  [[nodiscard]] std::int64_t particle_count() const;

  [[nodiscard]] const Plan& plan() const { return parts_.plan; }

  struct Counters {
    std::int64_t rebuilds = 0;
    std::int64_t iterations = 0, solved = 0;  ///< of solvers, and how often they were asked
    std::int64_t repeats = 0;                 ///< of loops
  };
  [[nodiscard]] const Counters& counters() const { return counters_; }
  [[nodiscard]] std::int64_t refreshes() const;  ///< of the halos

 private:
  void add_sets();
  void scatter();
  void begin();  ///< common end of both constructors
  void kick_half_a_step();
  void rebuild();
  void settle();
  [[nodiscard]] bool drifts_first() const;
  void widen_kernels();
  [[nodiscard]] ListSetting list_setting(const SetPair& pair);
  /// What the stages look at for each row.
  [[nodiscard]] std::vector<std::uint32_t> pairs_of_rows(std::size_t set) const;
  [[nodiscard]] std::vector<decomp::Census> census() const;
  void add_dawdling();
  void run(const std::vector<Entry>& entries, GlobalState& global);
  void run(const Stage& stage, StepState& state);
  [[nodiscard]] bool improve(const Entry& loop, GlobalState& global);
  [[nodiscard]] StepState state_of(std::size_t set, GlobalState& global,
                                   std::optional<std::size_t> other = std::nullopt);
  void reduce(std::int64_t request, bool left);
  void take_maxima();
  std::int64_t finish_step(std::int64_t request);
  [[nodiscard]] Findings find_leavers() const;
  void find_stale();
  void guard_motion(double next) const;
  [[nodiscard]] double look_back() const;
  [[noreturn]] void stop_at_fault() const;
  [[noreturn]] void stop_at_fastest(const std::string& what) const;
  [[nodiscard]] Findings find_infinite(const Particles& particles, Field field) const;
  [[nodiscard]] std::string place_of(const Particles& particles, std::size_t row) const;

  const decomp::Comm& comm_;
  Scene scene_;
  PositionScale scale_;
  Wrap wrap_;
  Parts parts_;
  Distribution distribution_;
  std::vector<ParticleSet> sets_;
  mutable std::optional<Particles> united_;  ///< of several sets, where it is up to date
  GlobalState global_;
  decomp::Timers timers_;
  Counters counters_;
  decomp::LargeVector<std::byte> rows_;
  Findings findings_;        ///< of this rank
  StepMaxima maxima_;        ///< of this rank and step
  decomp::Payload arrived_;  ///< contacts read from a checkpoint, until the first lists are there
  bool stale_ = true;
  std::vector<double> moved_;  ///< of each set: bound on any particle's path since the last rebuild [m]
  double growth_ = 0;          ///< of reaches until the end of the next step, as a share of what lists bear
  std::vector<decomp::Census> census_;  ///< of each set
};

}  // namespace sph
