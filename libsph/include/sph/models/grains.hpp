// Grains in contact: their fields, and the sweep that computes contacts with each other and with walls and moves them.
// What SPH does in passes and updates is one sweep here.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "sph/models/contact_table.hpp"
#include "sph/models/grain_pairs.hpp"
#include "sph/models/grain_walls.hpp"
#include "sph/models/model.hpp"
#include "sph/pairs/contact_context.hpp"

namespace sph {

[[nodiscard]] FieldSet grain_fields(const Scene& scene);

class Grains final : public Model {
 public:
  Grains(std::size_t set, const decomp::Comm& comm, const Scene& scene, const PositionScale& scale);
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
  [[nodiscard]] std::vector<Energy> energies() const override;
  void add_energies(const Particles& particles, EnergySums& sums) const override;

  /// Its stages; it must stay where it is.
  [[nodiscard]] Plan plan();
  /// Of a sweep.
  [[nodiscard]] ContactContext context(Particles& particles, double dt, const double* given = nullptr);

  [[nodiscard]] const ContactTable& table() const { return table_; }
  [[nodiscard]] const GrainWalls& walls() const { return walls_; }
  [[nodiscard]] GrainPairs& pairs() { return pairs_; }
  [[nodiscard]] const GrainPairs& pairs() const { return pairs_; }

 private:
  /// Contacts of the blocks, then kick and drift of their grains. begin_step() clears what a step sums.
  void begin_step(const Particles& particles, const GlobalState& global);
  void sweep(const StepState& state, std::span<const ContactBlock> blocks);

  const Scene* scene_;
  PositionScale scale_;
  ContactFusion fusion_;
  bool alone_;  ///< the scene has no other particles
  double dt_;
  ContactTable table_;
  GrainWalls walls_;
  GrainPairs pairs_;
  struct Now {
    WallsNow walls;
    FacetContacts facets{};
    std::vector<std::int64_t> force{};  ///< on the walls
    ContactSweep sweep{};               ///< what the sweeps have reported
  };
  Now now_;  ///< of this step
  struct Places {
    Reduction::Maximum strong, deep;  ///< a contact on any rank is
    Reduction::Sums halves;           ///< of the forces on walls
  };
  Places in_;  ///< the reduction
};

}  // namespace sph
