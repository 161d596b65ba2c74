// Plane walls beside grains: where stages of the scene put and move them, and servos, which answer to the force on
// them. What of a wall is state (its way, velocity, force) is in the global record.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sph/core/particles.hpp"
#include "sph/pairs/contact_lists.hpp"
#include "sph/scene/positions.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

class PlaneWalls {
 public:
  PlaneWalls(const Scene& scene, const PositionScale& scale, double force_quantum)
      : scene_(&scene), scale_(scale), force_quantum_(force_quantum) {}

  [[nodiscard]] std::size_t count() const { return scene_->grains.walls.size(); }
  /// As the scene describes them.
  void start(GlobalState& global) const;
  /// Takes the changes of the scene's stages that begin at or before the present time.
  void set_stage(GlobalState& global) const;
  /// A step's drift.
  void move(GlobalState& global) const;
  /// Servos answer to the forces of a step [quanta].
  void push(GlobalState& global, std::span<const std::int64_t> forces) const;

  [[nodiscard]] std::vector<PlaneNow> now(const GlobalState& global) const;
  [[nodiscard]] bool present(std::size_t wall, const GlobalState& global) const;
  [[nodiscard]] double longest_way(const GlobalState& global) const;  ///< of any in a step [m]
  /// Sums of all ranks from those of their low and high halves (ContactContext::wall_force) [quanta]. Throws
  /// GuardError where one is beyond 62 bits.
  [[nodiscard]] std::vector<std::int64_t> forces(std::span<const std::int64_t> halves,
                                                 const GlobalState& global) const;
  [[nodiscard]] double newton(std::int64_t quanta) const {
    return static_cast<double>(quanta) * force_quantum_;
  }

 private:
  /// A wall's part in a stage, the latest change that has begun winning.
  struct Now {
    bool present = true;
    Double3 velocity{};
    std::optional<double> force;
  };
  [[nodiscard]] Now now_of(std::size_t wall, const GlobalState& global) const;

  const Scene* scene_;
  PositionScale scale_;
  double force_quantum_;
};

}  // namespace sph
