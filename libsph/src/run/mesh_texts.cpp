#include "run/mesh_texts.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scene/mesh_volume.hpp"

namespace sph {

std::string mesh_text(const Scene& scene, const Parts& parts) {
  std::string out;
  for (std::size_t m = 0; m < scene.grains.meshes.size(); ++m) {
    const MeshWall& mesh = scene.grains.meshes[m];
    const TriangleSurface& surface = parts.grains->walls().meshes().surface(m);
    Double3 least = surface.vertices().front(), most = least;
    for (const Point3& v : surface.vertices())
      for (std::size_t a = 0; a < 3; ++a) {
        least[a] = std::min(least[a], v[a]);
        most[a] = std::max(most[a], v[a]);
      }
    out += fmt::format("mesh {}: {} facets;", mesh.name, surface.size());
    for (std::size_t a = 0; a < 3; ++a)
      out += fmt::format(" {} {:.6g} to {:.6g} m{}", "xyz"[a], least[a] + mesh.motion.centre[a],
                         most[a] + mesh.motion.centre[a], a < 2 ? "," : " at the start\n");
  }
  return out;
}

std::vector<std::string> open_regions(const Scene& scene) {
  std::vector<std::string> out;
  const std::vector<Region>& regions = scene.start.lattice.regions;
  for (std::size_t r = 0; r < regions.size(); ++r) {
    if (regions[r].mesh.volume == nullptr) continue;
    const std::size_t open = regions[r].mesh.volume->open_edges();
    if (open > 0)
      out.push_back(fmt::format(
          "start.region.{}.file: \"{}\" is not closed: {} of its edges have one triangle; what is inside "
          "is what most rays along x, y and z say: close it",
          r, regions[r].mesh.file, open));
  }
  return out;
}

}  // namespace sph
