// [[insertion]]: which grains come, and where. A grain's radius follows from its id, which counts those that have come; its
// place is tried at random, by id, step and attempt, until it touches nothing: no grain, no plane, no facet. All ranks choose
// the same grains from the same grains near the box, whatever their order.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "decomp/comm.hpp"
#include "sph/models/grain_walls.hpp"
#include "sph/scene/positions.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

/// One that a caller puts in.
struct GivenGrain {
  std::uint32_t group;
  double radius;               ///< [m]
  Double3 position, velocity;  ///< [m], [m/s]
};

struct InsertedGrain {
  std::uint64_t id;
  std::uint32_t group;
  std::array<std::int64_t, 3> position;  ///< [quanta], as double too
  Double3 velocity;                      ///< [m/s]
  double radius, mass;                   ///< [m], [kg]
};

[[nodiscard]] double speed_of(const Double3& velocity);

class Insertions {
 public:
  Insertions(const Scene& scene, const PositionScale& scale)
      : scene_(&scene), scale_(scale), wrap_(wrap_of(scene, scale)) {}

  [[nodiscard]] std::size_t count() const { return scene_->domain.openings.insertions.size(); }
  /// What comes in after the step that begins so, until it is the next turn of this one [kg]: 0 if it is not its turn.
  [[nodiscard]] double due(std::size_t insertion, const GlobalState& before) const;
  /// The grains that come, ids from `first_id`, of a mass of `due` or half a grain more or less; what is left of that
  /// for the next time replaces it, nothing where the box is full. `stays`: the rows that are there, and with them those that
  /// came `earlier` in this step. Collective.
  [[nodiscard]] std::vector<InsertedGrain> choose(const decomp::Comm& comm, std::size_t insertion,
                                                  const Particles& particles, const std::vector<bool>& stays,
                                                  std::span<const InsertedGrain> earlier,
                                                  const WallsNow& walls, std::uint64_t first_id,
                                                  std::int64_t step, double& due) const;
  /// Those that a caller gives, the same on all ranks, ids from `first_id`. Throws InputError, on all ranks, where one is not such a grain
  /// as the scene has, outside the domain, too fast for a step of `dt`, or deeper in others or walls than contacts may be. Collective.
  [[nodiscard]] std::vector<InsertedGrain> take(const decomp::Comm& comm, std::span<const GivenGrain> given,
                                                const Particles& particles, const std::vector<bool>& stays,
                                                const WallsNow& walls, std::uint64_t first_id,
                                                double dt) const;

 private:
  const Scene* scene_;
  PositionScale scale_;
  Wrap wrap_;
};

}  // namespace sph
