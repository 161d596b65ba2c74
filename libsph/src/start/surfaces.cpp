#include "start/surfaces.hpp"

#include <fmt/format.h>
#include <malloc.h>

#include <cstdio>
#include <optional>
#include <utility>

#include "decomp/machine_copy.hpp"
#include "files/agree.hpp"
#include "files/mesh_file.hpp"
#include "sph/core/error.hpp"

namespace sph {
namespace {

TriangleSurface surface_of(const Scene& scene, const MeshWall& mesh) {
  const std::string what = fmt::format("{}: mesh.{}.file: \"{}\"", scene.file, mesh.name, mesh.file);
  const std::string content = hash_of_file(mesh.file);
  if (content.empty()) throw InputError(what + " cannot be read; give an existing file");
  if (!mesh.content.empty() && content != mesh.content)
    throw InputError(what + " is another than the run began with; restore it, or begin a new run");
  Triangles read = read_triangles(mesh.file, what);
  for (auto& v : read.vertices)
    for (std::size_t a = 0; a < 3; ++a) v[a] = v[a] * mesh.scale + (mesh.origin[a] - mesh.motion.centre[a]);
  return {read.vertices, read.corners};
}

}  // namespace

std::vector<TriangleSurface> read_surfaces(const decomp::Comm& comm, const Scene& scene) {
  std::vector<TriangleSurface> surfaces;
  std::string problem;
  for (const MeshWall& mesh : scene.grains.meshes) {
    std::optional<TriangleSurface> read;
    const std::string failure = agree(comm, attempt([&] {
                                        if (comm.rank() == 0) read = surface_of(scene, mesh);
                                      }));
    if (!failure.empty()) throw InputError(failure);
    const decomp::MachineCopy copy =
        decomp::copy_to_machines(comm, read ? read->block() : nullptr, read ? read->bytes() : 0);
    surfaces.emplace_back(copy.bytes);
    if (problem.empty()) problem = agree(comm, copy.problem);
  }
#if defined(__GLIBC__)
  malloc_trim(0);  // what a reader has freed in small pieces, several times what is kept
#endif
  static bool told = false;  // a run reads them twice: to know what it needs, and for itself
  if (!problem.empty() && comm.rank() == 0 && !std::exchange(told, true))
    fmt::print(stderr,
               "peperite: warning: each rank holds its own copy of the meshes: /dev/shm: {}; where it is "
               "full, more room makes ranks share one\n",
               problem);
  return surfaces;
}

}  // namespace sph
