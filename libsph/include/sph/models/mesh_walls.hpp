// Meshes beside grains (scene/mesh_scene.hpp).
#pragma once

#include <span>
#include <vector>

#include "decomp/comm.hpp"
#include "sph/core/particles.hpp"
#include "sph/pairs/wall_places.hpp"
#include "sph/scene/positions.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

class MeshWalls {
 public:
  /// Reads the files. Throws InputError where one is broken, or another than the run began with. Collective.
  MeshWalls(const decomp::Comm& comm, const Scene& scene, const PositionScale& scale);

  [[nodiscard]] std::size_t count() const { return surfaces_.size(); }
  [[nodiscard]] const TriangleSurface& surface(std::size_t mesh) const { return surfaces_[mesh]; }
  [[nodiscard]] std::size_t bytes() const;  ///< on each machine
  /// `driven`: ways and velocities of those that a force moves.
  [[nodiscard]] std::vector<MeshNow> now(double time, std::span<const WallState> driven) const;
  [[nodiscard]] bool present(std::size_t mesh, double time) const;
  /// No point of any mesh goes further between two times, but for what drives it [m].
  [[nodiscard]] double longest_way(double from, double to) const;

 private:
  const Scene* scene_;
  PositionScale scale_;
  std::vector<TriangleSurface> surfaces_;
  std::vector<double> arms_;  ///< of each that turns: of its farthest point, from the axis [m]
};

}  // namespace sph
