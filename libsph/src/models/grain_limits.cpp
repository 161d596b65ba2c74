// How far grains and walls may go in a step.
//
// Two grains that move by m each see each other in time if the chord that they may jump, 2 m, belongs to an
// overlap below the largest one allowed, lambda r: m^2 = (2 r)^2 - (2 r - lambda r)^2 for two of the smallest
// radius r, and m <= r, or they could change places. Larger ones have longer chords.
#include "sph/models/grain_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "models/grain_constants.hpp"
#include "sph/core/error.hpp"
#include "sph/core/findings.hpp"
#include "sph/models/insertions.hpp"
#include "start/start_sounds.hpp"

namespace sph {
namespace {

double least_radius(const Scene& scene) {
  double radius = std::numeric_limits<double>::infinity();
  for (const Group& g : scene.groups)
    if (g.grain.least_radius > 0) radius = std::min(radius, g.grain.least_radius);
  return radius;
}

double speed_along(const Double3& velocity, const Double3& normal) {
  double along = 0;
  for (std::size_t a = 0; a < 3; ++a) along += velocity[a] * normal[a];
  return std::fabs(along);
}

/// As far as it is known before there are particles; infinite where no grain moves.
double step_of_scene(const Scene& scene) {
  const double dt = grain_step(scene);
  if (scene.time.dt || !scene.has_matter()) return dt;
  return std::min(dt,
                  scene.time.cfl * scene.kernel.smoothing_length / std::ranges::max(sounds_at_rest(scene)));
}

}  // namespace

bool any_grain_moves(const Scene& scene) {
  return std::ranges::any_of(scene.groups,
                             [](const Group& g) { return g.grain.largest_radius > 0 && !g.grain.fixed; });
}

double longest_grain_move(const Scene& scene) {
  const double lambda = scene.grains.contact.largest_overlap;
  return std::min(1.0, std::sqrt(4 * lambda - lambda * lambda)) * least_radius(scene);
}

std::string grain_move_text(const Scene& scene, double way) {
  return fmt::format(
      "it moves {:.6g} m in a step, and could pass others unseen beyond {:.6g} m, {:.2g} radii of the "
      "smallest "
      "grain; reduce time.dt",
      way, longest_grain_move(scene), longest_grain_move(scene) / least_radius(scene));
}

double grain_step(const Scene& scene) { return scene.time.dt.value_or(grain_time_steps(scene).recommended); }

// What turns is as fast as its farthest point. Of grains in melts there is no step that could be too long.
void check_mesh_speed(const Scene& scene, const MeshWall& mesh, double arm) {
  if (!any_grain_moves(scene) || scene.has_melt()) return;
  const double dt = step_of_scene(scene);
  double told = mesh.drive.largest_speed, spin = 0;
  for (const auto& [t, v] : mesh.motion.speed) told = std::max(told, std::fabs(v));
  for (const auto& [t, w] : mesh.motion.spin) spin = std::max(spin, std::fabs(w));
  const double swings = 2 * std::numbers::pi * mesh.motion.frequency * speed_of(mesh.motion.amplitude),
               turns = spin * arm, speed = told + swings + turns;
  if (speed * dt <= longest_grain_move(scene)) return;
  const char* key = mesh.drive.any()        ? "largest_speed"
                    : turns > told + swings ? "spin"
                    : swings > told         ? "amplitude"
                                            : "velocity";
  throw InputError(fmt::format("{}: mesh.{}: mesh \"{}\" at {:.6g} m/s: {}, or this speed", scene.file, key,
                               mesh.name, speed, grain_move_text(scene, speed * dt)));
}

// Grains of one size lie on a plane no closer than 2 sqrt(3) r^2 each. N of them on a mass M, all with stiffness k along
// (n d)^2 of their normals: w^2 = N k (n d)^2 / M, and dt < 2 / w.
double least_mesh_mass(const Scene& scene, const MeshWall& mesh, const TriangleSurface& surface) {
  const double radius = least_radius(scene), dt = grain_step(scene);
  const auto vertices = surface.vertices();
  double area = 0;
  for (std::size_t t = 0; t < surface.size(); ++t) {
    const auto& corners = surface.triangles()[t];
    Point3 side[2], across{};
    double along = 0, square = 0;
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t k : {0, 1}) side[k][a] = vertices[corners[k + 1]][a] - vertices[corners[0]][a];
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
      across[a] = side[0][b] * side[1][c] - side[0][c] * side[1][b];
      along += across[a] * mesh.motion.direction[a];
      square += across[a] * across[a];
    }
    area += 0.5 * along * along / std::sqrt(square);
  }
  const double per_grain = 2 * std::numbers::sqrt3 * radius * radius;
  return area / per_grain * stiffest_contact(scene, radius) * dt * dt / 4;
}

void check_wall_speeds(const Scene& scene) {
  const double dt = step_of_scene(scene), limit = longest_grain_move(scene);
  if (!any_grain_moves(scene)) return;
  const auto check = [&](const Wall& wall, const std::string& key, double speed) {
    if (speed * dt <= limit) return;
    throw InputError(fmt::format("{}: {}: wall \"{}\" at {:.6g} m/s: {}, or this speed", scene.file, key,
                                 wall.name, speed, grain_move_text(scene, speed * dt)));
  };
  for (const Wall& wall : scene.grains.walls) {
    check(wall, "wall.velocity", speed_along(wall.velocity, wall.normal));
    check(wall, "wall.largest_speed", wall.largest_speed);
  }
  for (const MeshWall& mesh : scene.grains.meshes) check_mesh_speed(scene, mesh, 0);
  for (const Insertion& in : scene.domain.openings.insertions) {
    const double speed = speed_of(in.velocity);
    if (speed * dt > limit)
      throw InputError(fmt::format("{}: insertion.velocity: is {:.6g} m/s: {}, or this speed", scene.file,
                                   speed, grain_move_text(scene, speed * dt)));
  }
  for (const WallStage& stage : scene.grains.stages)
    for (const WallChange& change : stage.walls) {
      const Wall& wall = scene.grains.walls[static_cast<std::size_t>(change.wall)];
      if (change.velocity)
        check(wall, fmt::format("stage \"{}\": velocity", stage.name),
              speed_along(*change.velocity, wall.normal));
    }
}

void check_start_speeds(const decomp::Comm& comm, const Scene& scene, const Particles& particles) {
  const double dt = step_of_scene(scene), limit = longest_grain_move(scene);
  const double* v = particles.data<Field::velocity>();
  Findings found;
  for (std::size_t i = 0; i < particles.owned(); ++i) {
    if (scene.groups[particles.data<Field::group>()[i]].grain.fixed) continue;
    double speed2 = 0;
    for (std::size_t a = 0; a < 3; ++a) speed2 += v[i * 3 + a] * v[i * 3 + a];
    const double way = std::sqrt(speed2) * dt;
    const std::uint64_t id = particles.data<Field::id>()[i];
    if (!(way <= limit))
      found.add(id, [&] {
        return fmt::format("start: grain {} has a speed of {:.6g} m/s: {}, or this speed", id,
                           std::sqrt(speed2), grain_move_text(scene, way));
      });
  }
  if (const std::string text = found.agree(comm); !text.empty()) throw InputError(scene.file + ": " + text);
}

}  // namespace sph
