// Where grains come in and leave: [[insertion]], [[outlet]], domain.leaves. Those that a step leaves in an outlet that is open
// then, or outside the domain beyond a face that deletes, are no more, nor are their contacts; insertions then put in theirs.
// Which grains these are follows from the state at the end of a step alone.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sph/models/grain_pairs.hpp"
#include "sph/models/grain_walls.hpp"
#include "sph/models/insertions.hpp"
#include "sph/models/model.hpp"

namespace sph {

struct NewParticle;

class GrainOpenings final : public Model {
 public:
  /// `walls` and `pairs` stay where they are.
  GrainOpenings(std::size_t set, const Scene& scene, const PositionScale& scale, const GrainWalls& walls,
                GrainPairs& pairs);

  void reserve(Reduction& reduction) override { in_.events = reduction.add_sums(1); }
  [[nodiscard]] double start(const decomp::Comm& comm, Particles& particles, GlobalState& global) override;
  [[nodiscard]] bool report(const StepState& state, Reduction& reduction) override;
  [[nodiscard]] std::optional<double> turn_over(const Distribution& distribution, const Reduction& reduction,
                                                ParticleSet& set, GlobalState& global) override;
  /// What a caller wants between steps: the grains `gone` by their ids, ascending, leave as through a face, those given come. The same on
  /// all ranks. Lists must be made anew. Throws InputError, on all ranks, before anything is changed. Collective.
  void exchange(const Distribution& distribution, std::span<const std::uint64_t> gone,
                std::span<const GivenGrain> come, ParticleSet& set, GlobalState& global);

 private:
  /// A row, and the outlet through which it leaves; past the last: a face.
  struct Leaver {
    std::size_t row, passage;
  };
  /// lower <= x < upper [quanta]
  struct Box {
    std::array<std::int64_t, 3> lower{}, upper{};
    bool open = true;  ///< in the step at hand
    [[nodiscard]] bool contains(const std::array<std::int64_t, 3>& x) const;
  };

  [[nodiscard]] std::size_t faces() const { return outlets_.size(); }  ///< their passage
  void open_outlets(const GlobalState& before);
  void find_leavers(const Particles& particles);
  void find_leavers(const decomp::Comm& comm, const Particles& particles, std::span<const std::uint64_t> ids);
  [[nodiscard]] std::vector<bool> staying(const Particles& particles) const;  ///< by row
  [[nodiscard]] std::uint64_t next_id(const GlobalState& global) const;
  /// Returns their ids, of all ranks, ascending.
  [[nodiscard]] std::vector<std::uint64_t> count_leavers(const decomp::Comm& comm, ParticleSet& set,
                                                         GlobalState& global) const;
  /// Return those that are this rank's: of insertions, and of grains that come through this passage.
  [[nodiscard]] std::vector<NewParticle> put_in(const Distribution& distribution,
                                                const std::vector<bool>& stays, ParticleSet& set,
                                                GlobalState& global) const;
  [[nodiscard]] std::vector<NewParticle> let_in(std::span<const InsertedGrain> grains, std::size_t passage,
                                                const Distribution& distribution, ParticleSet& set,
                                                GlobalState& global) const;
  void replace_rows(Particles& particles, const std::vector<bool>& stays, std::span<const std::uint64_t> gone,
                    std::span<const NewParticle> come) const;

  const Scene* scene_;
  PositionScale scale_;
  Wrap wrap_;
  const GrainWalls* walls_;
  GrainPairs* pairs_;
  Insertions insertions_;
  std::vector<Box> outlets_;
  Box domain_;
  // Of this rank, in the step at hand.
  std::vector<Leaver> leavers_;
  std::vector<double> due_;  ///< [kg]
  struct Places {
    Reduction::Sums events;
  };
  Places in_;  ///< the reduction
};

}  // namespace sph
