// Walls beside grains: planes, where stages of the scene put and move them, and servos, which answer to the force on them; meshes.
// What of a wall is state (way and velocity of a plane or a driven mesh, the force) is in the global record, planes first.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sph/core/particles.hpp"
#include "sph/models/mesh_walls.hpp"
#include "sph/pairs/wall_places.hpp"
#include "sph/scene/positions.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

class GrainWalls {
 public:
  /// Throws InputError where one is so far away that its distance from grains is no number.
  GrainWalls(const decomp::Comm& comm, const Scene& scene, const PositionScale& scale, double force_quantum);

  [[nodiscard]] std::size_t count() const { return planes() + meshes_.count(); }
  [[nodiscard]] std::size_t planes() const { return scene_->grains.walls.size(); }
  [[nodiscard]] const MeshWalls& meshes() const { return meshes_; }
  /// As the scene describes them.
  void start(GlobalState& global) const;
  /// Takes the changes of the scene's stages that begin at or before the present time.
  void set_stage(GlobalState& global) const;
  /// A step's drift. Throws GuardError where one goes as far.
  void move(GlobalState& global) const;
  /// Servos and masses answer to the forces of a step [quanta].
  void push(GlobalState& global, std::span<const std::int64_t> forces) const;

  [[nodiscard]] WallsNow now(const GlobalState& global) const;
  /// By its key (wall_key).
  [[nodiscard]] bool present(std::uint64_t key, const GlobalState& global) const;
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
  /// Where it was at the start [m].
  [[nodiscard]] const Double3& began(std::size_t wall) const {
    return wall < planes() ? scene_->grains.walls[wall].point
                           : scene_->grains.meshes[wall - planes()].motion.centre;
  }
  void drive(std::size_t mesh, GlobalState& global) const;

  const Scene* scene_;
  PositionScale scale_;
  double force_quantum_;
  MeshWalls meshes_;
};

}  // namespace sph
