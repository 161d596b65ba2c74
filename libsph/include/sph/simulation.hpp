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
#include "sph/grains.hpp"
#include "sph/physics.hpp"
#include "sph/plan/halo_exchange.hpp"
#include "sph/scene.hpp"
#include "sph/sph_pairs.hpp"

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
  void refresh_halo(FieldSet fields);
  /// The same for contacts: all that are there now are in the lists, and halo copies are where their owners
  /// are. Rebuilds early what the next step would rebuild first.
  void refresh_contacts();

  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] const decomp::Comm& comm() const { return comm_; }
  [[nodiscard]] const Particles& particles() const { return particles_; }
  [[nodiscard]] const GlobalState& global() const { return global_; }
  [[nodiscard]] const PositionScale& scale() const { return scale_; }
  [[nodiscard]] const Wrap& wrap() const { return physics_.constants().wrap; }
  [[nodiscard]] const Physics& physics() const { return physics_; }
  [[nodiscard]] const Distribution& distribution() const { return distribution_; }
  [[nodiscard]] const NeighbourLists& lists() const { return sph_pairs_.lists(); }
  [[nodiscard]] const Grains* grains() const { return grains_ ? &*grains_ : nullptr; }
  [[nodiscard]] bool has_history() const { return grains_ && grains_->lists().history() > 0; }
  /// Histories of this rank's contacts, one entry per contact of a row: what travels and is checkpointed.
  [[nodiscard]] decomp::Payload contacts() const {
    return grains_ ? grains_->lists().pack(particles_) : decomp::Payload{};
  }
  [[nodiscard]] decomp::Timers& timers() { return timers_; }
  /// Of a simulation that has made no step since its checkpoint: computes what a snapshot holds besides the
  /// state, the pressure on walls. Changes no bit of the state. Collective.
  void derive_for_output();
  [[nodiscard]] std::string fingerprint() const;
  [[nodiscard]] std::int64_t particle_count() const { return count_; }

  [[nodiscard]] const Plan& plan() const { return plan_; }

  struct Counters {
    std::int64_t rebuilds = 0;
    std::int64_t iterations = 0, solved = 0;  ///< of solvers, and how often they were asked
    std::int64_t repeats = 0;                 ///< of loops
  };
  [[nodiscard]] const Counters& counters() const { return counters_; }
  [[nodiscard]] std::int64_t refreshes() const { return exchange_.refreshes(); }  ///< of the halo

 private:
  void add_models();
  void find_common_motion(const Shifting& shifting);
  void begin();  ///< common end of both constructors
  void kick_half_a_step();
  void rebuild();
  void widen_kernels();
  [[nodiscard]] ListSetting list_setting();
  /// What the stages look at for each row.
  [[nodiscard]] std::vector<std::uint32_t> pairs_of_rows() const;
  void add_dawdling();
  void run(const std::vector<Entry>& entries);
  void run(const std::vector<Entry>& entries, StepState& state);
  void run(const Stage& stage, StepState& state);
  [[nodiscard]] bool improve(const Entry& loop, StepState& state);
  [[nodiscard]] StepState state_of_step();
  void reduce(std::int64_t request, bool left);
  void take_maxima();
  std::int64_t finish_step(std::int64_t request);
  [[nodiscard]] Findings find_leavers() const;
  void find_stale(double next);
  void guard_motion(double next) const;
  [[nodiscard]] double look_back() const;
  [[noreturn]] void stop_at_fault() const;
  [[noreturn]] void stop_at_fastest(const std::string& what) const;
  [[nodiscard]] std::vector<double> metres_of(std::size_t row) const;

  const decomp::Comm& comm_;
  Scene scene_;
  PositionScale scale_;
  Physics physics_;
  std::optional<Grains> grains_;
  Distribution distribution_;
  Particles particles_;
  SphPairs sph_pairs_;
  SetPair* pairs_ = nullptr;
  GlobalState global_;
  decomp::Timers timers_;
  Counters counters_;
  std::vector<bool> is_wall_group_;
  decomp::LargeVector<std::byte> rows_;
  void changed(FieldSet fields) { exchange_.changed(particles_, fields); }

  std::vector<Model*> models_;
  Plan plan_;
  Reduction reduction_;
  HaloExchange exchange_;
  Findings findings_;        ///< of this rank
  StepMaxima maxima_;        ///< of this rank and step
  decomp::Payload arrived_;  ///< contacts read from a checkpoint, until the first lists are there
  bool stale_ = true;
  double moved_ = 0;   ///< bound on any particle's path since the last rebuild [m]
  double growth_ = 0;  ///< of reaches until the end of the next step, as a share of what lists bear
  std::int64_t count_ = 0;
  decomp::Census census_;
};

}  // namespace sph
