// [[mesh]]: walls of triangles.
#include <fmt/format.h>

#include "files/mesh_file.hpp"
#include "keys/mesh_keys.hpp"
#include "keys/prescribed_motion.hpp"

namespace sph {
namespace {

using MeshReader = Reader<keys::mesh>;

/// A mesh knows nothing of its images.
void check_periods(const MeshReader& table, const Scene& scene) {
  for (std::size_t a = 0; a < 3; ++a)
    if (scene.domain.periodic[a])
      table.fail("file", fmt::format("is of a mesh, and {} is periodic", "xyz"[a]),
                 "grains would pass beside its images: set domain.periodic to false");
}

/// A servo or a mass, which moves along the direction alone.
void read_drive(const MeshReader& table, MeshWall& mesh) {
  const MeshDrive& drive = mesh.drive;
  table.not_both("servo_gain", "mass");
  for (const auto key : {MeshReader::Name<>("force"), MeshReader::Name<>("largest_speed")})
    table.only_if(drive.any(), key, "it is of a servo or a mass: give servo_gain or mass");
  if (!drive.any()) return;
  if (!table.has("direction")) table.fail_missing("direction", "a servo or a mass moves along it");
  if (!table.has("largest_speed")) table.fail_missing("largest_speed", "it goes no faster, in m/s");
  if (drive.servo_gain > 0 && !drive.force) table.fail_missing("force", "a servo presses with it, in N");
}

MeshWall read_mesh(const MeshReader& table, const Scene& scene) {
  MeshWall mesh;
  table.read(mesh);
  check_periods(table, scene);
  read_drive(table, mesh);
  read_motion(table, mesh.motion, mesh.drive.any());
  if (mesh.drive.any()) {
    constexpr std::string_view why = "a servo or a mass moves along its direction alone";
    table.only_if(mesh.motion.speed.empty(), "velocity", why);
    table.only_if(mesh.motion.spin.empty(), "spin", why);
    table.only_if(mesh.motion.amplitude == Double3{}, "amplitude", why);
  }
  if (mesh.end && !(mesh.begin < *mesh.end))
    table.fail("end", fmt::format("is {} s, not after {} s, when it begins", *mesh.end, mesh.begin),
               "it would never be there");
  return mesh;
}

}  // namespace

std::vector<MeshWall> read_meshes(const TopReader& top, const Scene& scene) {
  std::vector<MeshWall> meshes;
  std::vector<std::string> names;
  for (const Wall& wall : scene.grains.walls) names.push_back(wall.name);
  for (const MeshReader& table : top.tables<keys::mesh>()) {
    names.push_back(read_name(table, "wall", names));
    meshes.push_back(read_mesh(table, scene));
    table.finish();
  }
  return meshes;
}

void find_meshes(const TopReader& top, Scene& scene) {
  const auto tables = top.tables<keys::mesh>();
  for (std::size_t k = 0; k < tables.size(); ++k) {
    MeshWall& mesh = scene.grains.meshes[k];
    check_file(tables[k], "file", mesh.file);
    if (mesh.content.empty()) mesh.content = hash_of_file(mesh.file);
  }
}

void write_meshes(SceneWriter& out, const Scene& scene) {
  for (const MeshWall& mesh : scene.grains.meshes) {
    out.table(keys::mesh, mesh);
    write_motion(out, mesh.motion);
  }
}

}  // namespace sph
