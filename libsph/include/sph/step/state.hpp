// What there is of a scene at one moment, on all ranks: what files, monitors and reports look at. A Simulation is a
// state that can go on.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "decomp/comm.hpp"
#include "sph/checkpoint/checkpoint.hpp"
#include "sph/models/parts.hpp"
#include "sph/plan/distribution.hpp"
#include "sph/plan/particle_set.hpp"
#include "sph/scene/positions.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

class State {
 public:
  State(const State&) = delete;  // its models stay where they are
  State& operator=(const State&) = delete;

  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] const decomp::Comm& comm() const { return comm_; }
  [[nodiscard]] const PositionScale& scale() const { return scale_; }
  [[nodiscard]] const Wrap& wrap() const { return wrap_; }
  [[nodiscard]] const GlobalState& global() const { return global_; }
  [[nodiscard]] const Distribution& distribution() const { return distribution_; }

  [[nodiscard]] std::span<const ParticleSet> sets() const { return sets_; }
  [[nodiscard]] const Particles& particles(std::size_t set) const { return sets_[set].particles; }
  /// Of all sets, as files have them. Of several sets it is a copy, without halo, good until the next step.
  [[nodiscard]] const Particles& particles() const;
  [[nodiscard]] std::int64_t particle_count() const;  ///< of all sets and ranks

  [[nodiscard]] std::span<Model* const> models() const { return parts_.models; }
  [[nodiscard]] const Plan& plan() const { return parts_.plan; }
  [[nodiscard]] const Physics* physics() const { return parts_.physics ? &*parts_.physics : nullptr; }
  [[nodiscard]] const NeighbourLists& lists() const { return parts_.sph_pairs->lists().all; }
  [[nodiscard]] const Grains* grains() const { return parts_.grains ? &*parts_.grains : nullptr; }
  [[nodiscard]] Melt* melt() const { return parts_.melt.get(); }
  [[nodiscard]] bool has_history() const {
    return grains() != nullptr && grains()->pairs().lists().history() > 0;
  }
  /// Histories of this rank's contacts, one entry per contact of a row of particles(): what is checkpointed.
  [[nodiscard]] decomp::Payload contacts() const;

  /// Collective.
  [[nodiscard]] std::string fingerprint() const;

 protected:
  /// Without particles.
  State(const decomp::Comm& comm, const Scene& scene, const PositionScale& scale);

  const decomp::Comm& comm_;
  Scene scene_;
  PositionScale scale_;
  Wrap wrap_;
  Parts parts_;
  Distribution distribution_;
  std::vector<ParticleSet> sets_;
  mutable std::optional<Particles> united_;  ///< of several sets, where it is up to date
  GlobalState global_;
};

}  // namespace sph
