// The physics of a scene of grains: its fields, the constants of its contacts, walls and stages, and the
// sweep that computes contacts and moves the grains. What SPH does in passes and updates is one sweep here.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sph/core/findings.hpp"
#include "sph/core/particles.hpp"
#include "sph/models/model.hpp"
#include "sph/pairs/contact_context.hpp"
#include "sph/pairs/set_pair.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

[[nodiscard]] FieldSet grain_fields(const Scene& scene);

/// Time steps of a scene of grains [s].
struct GrainTimeSteps {
  double recommended = 0;  ///< the default
  double advised = 0;      ///< above it `check` warns: 0.2 Rayleigh times, or 0.17 sqrt(m/k)
  double limit = 0;        ///< above it a single contact is unstable: refused
};
[[nodiscard]] GrainTimeSteps grain_time_steps(const Scene& scene);
[[nodiscard]] double grain_step(const Scene& scene);  ///< time.dt, or the default [s]

/// No grain and no wall may go further in a step [m]; what is said of one that would.
[[nodiscard]] double longest_grain_move(const Scene& scene);
[[nodiscard]] std::string grain_move_text(const Scene& scene, double way);
/// Throw InputError.
void check_wall_speeds(const Scene& scene);
void check_start_speeds(const decomp::Comm& comm, const Scene& scene, const Particles& particles);

class Grains final : public Model, public SetPair {
 public:
  Grains(std::size_t set, const Scene& scene, const PositionScale& scale);
  Grains(const Grains&) = delete;  // its stages hold on to it
  Grains& operator=(const Grains&) = delete;

  void reserve(Reduction& reduction) override;
  [[nodiscard]] double start(const decomp::Comm& comm, Particles& particles, GlobalState& global) override;
  void check_start(const decomp::Comm& comm, const StepState& state) const override;
  [[nodiscard]] double longest_step(const Reduction&) const override { return dt_; }
  [[nodiscard]] bool report(const StepState& state, Reduction& reduction) override;
  void guard(const decomp::Comm& comm, const StepState& state, const Reduction& reduction) const override;
  /// Walls drift with the velocity they had, servos answer to the force of this step.
  void act(const Reduction& reduction, GlobalState& global) override;
  [[nodiscard]] double path(const GlobalState& global, double speed) const override;
  /// Of this rank's grains, or of a wall.
  [[nodiscard]] std::optional<double> longest_way(const Particles& particles,
                                                  const GlobalState& global) const override;

  [[nodiscard]] std::size_t set() const { return Model::set(); }
  /// Its stages; it must stay where it is.
  [[nodiscard]] Plan plan();
  // Its pairs: half lists, whose contacts carry their history.
  [[nodiscard]] FieldSet constants() const override {
    return {Field::id, Field::position, Field::radius, Field::mass, Field::group};
  }
  [[nodiscard]] bool carries() const override { return true; }
  [[nodiscard]] decomp::Payload send(const Particles& particles, decomp::Payload arrived) override;
  void rebuild(const Particles& particles, const ListSetting& setting, const decomp::Payload& carried,
               std::span<const std::uint32_t> order) override;
  void count(const RowRanges& ranges, std::span<std::uint32_t> entries) const override;

  /// Fields of the halo a sweep reads that change with every step.
  [[nodiscard]] FieldSet reads() const;

  [[nodiscard]] ContactLists& lists() { return lists_; }
  [[nodiscard]] const ContactLists& lists() const { return lists_; }

  /// Takes the changes of the scene's stages that begin at or before the present time.
  void set_stage(GlobalState& global) const;

  /// Contacts of the blocks, then kick and drift of their grains. begin_step() clears what a step sums.
  void begin_step(const Particles& particles, const GlobalState& global);
  void sweep(Particles& particles, std::span<const ContactBlock> blocks, const RowRanges& ranges, double dt);
  [[nodiscard]] ContactContext context(Particles& particles, double dt);  ///< of a sweep

  /// Walls as they are now.
  [[nodiscard]] std::vector<PlaneNow> planes(const GlobalState& global) const;
  /// Of two groups, in the order of ContactConstants.
  [[nodiscard]] std::span<const double, 8> pair_constants(std::size_t a, std::size_t b) const {
    return std::span<const double, 8>(constants_.data() + 8 * (a * scene_->groups.size() + b), 8);
  }

  [[nodiscard]] double force_quantum() const { return force_quantum_; }
  [[nodiscard]] double torque_quantum() const { return torque_quantum_; }
  [[nodiscard]] double wall_force_newton(std::int64_t quanta) const {
    return static_cast<double>(quanta) * force_quantum_;
  }
  [[nodiscard]] std::int64_t touching_pairs() const;  ///< listed on this rank, walls not counted
  struct Counters {
    std::int64_t created = 0, ended = 0, carried = 0;
  };
  [[nodiscard]] const Counters& counters() const { return counters_; }

 private:
  /// A wall's part in a stage, the latest change that has begun winning.
  struct WallNow {
    bool present = true;
    Double3 velocity{};
    std::optional<double> force;
  };
  [[nodiscard]] WallNow wall_now(std::size_t wall, const GlobalState& global) const;
  void move_walls(GlobalState& global) const;
  /// Servos answer to the forces of a step.
  void push_walls(GlobalState& global, std::span<const std::int64_t> wall_force) const;
  [[nodiscard]] double longest_wall_way(const GlobalState& global) const;  ///< in a step [m]
  /// From their two halves, summed over all ranks.
  [[nodiscard]] std::vector<std::int64_t> wall_forces(std::span<const std::int64_t> halves,
                                                      const GlobalState& global) const;
  [[nodiscard]] std::string text_of(const ContactFault& fault) const;
  [[nodiscard]] std::string text_of_place(const std::int64_t* quanta) const;
  void find_too_fast(const StepState& state, Findings& found) const;
  /// Contacts in rebuild() that the lists do not hold though their pairs cannot have parted so far.
  void find_lost(const Particles& particles, const GlobalState& global, double skin, Findings& lost) const;
  [[nodiscard]] ContactCensus find_pairs(const Particles& particles, const ListSetting& setting,
                                         const decomp::Payload& carried,
                                         std::span<const std::uint32_t> order);
  void find_constants();
  void find_quanta();

  const Scene* scene_;
  PositionScale scale_;
  Wrap wrap_;
  ContactFusion fusion_;
  ContactLists lists_;
  bool alone_;  ///< the scene has no other particles
  decomp::LargeVector<double> constants_;
  std::vector<bool> fixed_;
  double force_quantum_ = 1, torque_quantum_ = 1, dt_ = 0, longest_move_ = 0;
  ContactSums sums_;
  ContactCensus sent_;  ///< of what travels
  std::vector<PlaneNow> planes_;
  std::vector<std::int64_t> wall_force_;
  std::vector<std::int64_t> reference_;  ///< positions at the last rebuild [quanta]
  std::vector<std::array<std::int64_t, 3>> wall_reference_;
  ContactSweep sweep_;
  Reduction::Maximum strong_, deep_;  ///< a contact on any rank is
  Reduction::Sums halves_;            ///< of the forces on walls
  Counters counters_;
};

}  // namespace sph
