// [[mesh]]: walls of triangles.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "files/mesh_file.hpp"
#include "keys/mesh_keys.hpp"
#include "keys/scene_resolve.hpp"
#include "keys/scene_writer.hpp"
#include "keys/time_curve.hpp"

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

/// Empty where it is 0 at all times.
TimeCurve read_motion(const std::optional<KeyValue>& value, Dimension dim) {
  TimeCurve curve = read_curve(value, dim);
  if (std::ranges::all_of(curve, [](const auto& point) { return point[1] == 0; })) curve.clear();
  return curve;
}

MeshWall read_mesh(const MeshReader& table, const Scene& scene) {
  MeshWall mesh;
  table.read(mesh);
  check_periods(table, scene);
  mesh.motion.speed = read_motion(table.value("velocity"), dimension::speed);
  mesh.motion.spin = read_motion(table.value("spin"), dimension::rate);
  const auto normalise = [&](MeshReader::Name<> key, Double3& of) {
    const std::optional<Double3> unit = unit_vector(of);
    if (!unit) table.fail(key, "has no direction", "give a vector of any length");
    of = *unit;
  };
  normalise("direction", mesh.motion.direction);
  normalise("axis", mesh.motion.axis);
  table.only_if(table.has("velocity"), "direction", "it is of velocity, which is not given");
  table.only_if(table.has("spin"), "axis", "it is of spin, which is not given");
  table.only_if(table.has("spin"), "centre", "it is of spin, which is not given");
  if (table.has("amplitude") != table.has("frequency"))
    table.fail_missing(
        table.has("amplitude") ? MeshReader::Name<>("frequency") : MeshReader::Name<>("amplitude"),
        "an oscillation has both");
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
    const std::filesystem::path folder = std::filesystem::path(scene.file).parent_path();
    mesh.file = std::filesystem::absolute(folder / mesh.file).lexically_normal().string();
    check_file(tables[k], "file", mesh.file);
    if (mesh.content.empty()) mesh.content = hash_of_file(mesh.file);
  }
}

void write_meshes(SceneWriter& out, const Scene& scene) {
  for (const MeshWall& mesh : scene.grains.meshes) {
    out.table(keys::mesh, mesh);
    write_curve(out, "velocity", mesh.motion.speed.empty() ? TimeCurve{{0, 0}} : mesh.motion.speed);
    write_curve(out, "spin", mesh.motion.spin.empty() ? TimeCurve{{0, 0}} : mesh.motion.spin);
  }
}

}  // namespace sph
