#include "start/surfaces.hpp"

#include <fmt/format.h>

#include <utility>

#include "files/agree.hpp"
#include "files/mesh_file.hpp"
#include "sph/core/error.hpp"

namespace sph {
namespace {

std::shared_ptr<const TriangleSurface> surface_of(const Scene& scene, const MeshWall& mesh) {
  const std::string what = fmt::format("{}: mesh.{}.file: \"{}\"", scene.file, mesh.name, mesh.file);
  const std::string content = hash_of_file(mesh.file);
  if (content.empty()) throw InputError(what + " cannot be read; give an existing file");
  if (!mesh.content.empty() && content != mesh.content)
    throw InputError(what + " is another than the run began with; restore it, or begin a new run");
  Triangles read = read_triangles(mesh.file, what);
  for (auto& v : read.vertices)
    for (std::size_t a = 0; a < 3; ++a) v[a] = v[a] * mesh.scale + (mesh.origin[a] - mesh.motion.centre[a]);
  return std::make_shared<const TriangleSurface>(std::move(read.vertices), std::move(read.corners));
}

}  // namespace

std::vector<std::shared_ptr<const TriangleSurface>> read_surfaces(const decomp::Comm& comm,
                                                                  const Scene& scene) {
  std::vector<std::shared_ptr<const TriangleSurface>> surfaces;
  const std::string failure = agree(comm, attempt([&] {
                                      for (const MeshWall& mesh : scene.grains.meshes)
                                        surfaces.push_back(surface_of(scene, mesh));
                                    }));
  if (!failure.empty()) throw InputError(failure);
  return surfaces;
}

}  // namespace sph
