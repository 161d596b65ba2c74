// Meshes beside grains. Where one is, and how fast, follows from the time alone (scene/mesh_scene.hpp): it is no state.
#pragma once

#include <memory>
#include <vector>

#include "decomp/comm.hpp"
#include "sph/pairs/wall_places.hpp"
#include "sph/scene/positions.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

class MeshWalls {
 public:
  /// Reads the files. Throws InputError where one is broken, or another than the run began with. Collective.
  MeshWalls(const decomp::Comm& comm, const Scene& scene, const PositionScale& scale);

  [[nodiscard]] std::size_t count() const { return surfaces_.size(); }
  [[nodiscard]] const TriangleSurface& surface(std::size_t mesh) const { return *surfaces_[mesh]; }
  [[nodiscard]] std::size_t bytes() const;
  [[nodiscard]] std::vector<MeshNow> now(double time) const;
  [[nodiscard]] bool present(std::size_t mesh, double time) const;
  /// No point of any mesh goes further between two times [m].
  [[nodiscard]] double longest_way(double from, double to) const;

 private:
  const Scene* scene_;
  PositionScale scale_;
  std::vector<std::shared_ptr<const TriangleSurface>> surfaces_;
};

}  // namespace sph
