#include "sph/models/mesh_walls.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sph/core/exact_math.hpp"
#include "sph/models/grain_limits.hpp"
#include "start/surfaces.hpp"

namespace sph {
namespace {

/// Rodrigues' rotation about a unit vector, by rows.
std::array<Point3, 3> rotation_of(const Point3& n, double angle) {
  const double c = exact_cos(angle), s = exact_sin(angle), rest = 1 - c;
  return {{{c + rest * n[0] * n[0], rest * n[0] * n[1] - s * n[2], rest * n[0] * n[2] + s * n[1]},
           {rest * n[1] * n[0] + s * n[2], c + rest * n[1] * n[1], rest * n[1] * n[2] - s * n[0]},
           {rest * n[2] * n[0] - s * n[1], rest * n[2] * n[1] + s * n[0], c + rest * n[2] * n[2]}}};
}

/// Of its points from an axis through its centre [m].
double longest_arm(const TriangleSurface& surface, const Point3& axis) {
  double longest = 0;
  for (const Point3& x : surface.vertices()) {
    const double along = x[0] * axis[0] + x[1] * axis[1] + x[2] * axis[2];
    double square = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      const double away = x[a] - along * axis[a];
      square += away * away;
    }
    longest = std::max(longest, square);
  }
  return std::sqrt(longest);
}

}  // namespace

MeshWalls::MeshWalls(const decomp::Comm& comm, const Scene& scene, const PositionScale& scale)
    : scene_(&scene), scale_(scale), surfaces_(read_surfaces(comm, scene)) {
  for (std::size_t m = 0; m < count(); ++m) {
    const PrescribedMotion& motion = scene.grains.meshes[m].motion;
    arms_.push_back(motion.spin.empty() ? 0.0 : longest_arm(surfaces_[m], motion.axis));
    check_mesh_speed(scene, scene.grains.meshes[m], arms_[m]);
  }
}

std::size_t MeshWalls::bytes() const {
  std::size_t sum = 0;
  for (const auto& surface : surfaces_) sum += surface.bytes();
  return sum;
}

std::vector<MeshNow> MeshWalls::now(double time, std::span<const WallState> driven) const {
  std::vector<MeshNow> out;
  for (std::size_t m = 0; m < count(); ++m) {
    const MeshWall& mesh = scene_->grains.meshes[m];
    const PrescribedMotion& motion = mesh.motion;
    const MotionNow moved = motion_at(motion, time);
    MeshNow place{};
    place.surface = &surfaces_[m];
    place.way = moved.way;
    place.velocity = moved.velocity;
    if (mesh.drive.any()) place.velocity = driven[m].velocity;
    for (std::size_t a = 0; a < 3; ++a) {
      place.centre[a] = scale_.quanta(motion.centre[a]) + driven[m].offset[a];
      place.spin[a] = moved.spin * motion.axis[a];
      if (mesh.drive.mass > 0) place.lightness[a] = motion.direction[a] / std::sqrt(mesh.drive.mass);
    }
    place.rotation = rotation_of(motion.axis, moved.angle);
    place.smooth_cosine = exact_cos(mesh.smooth_angle * (std::numbers::pi / 180));
    place.group = static_cast<std::uint32_t>(mesh.group);
    place.present = present(m, time);
    place.listed = !mesh.end || time < *mesh.end;
    out.push_back(place);
  }
  return out;
}

bool MeshWalls::present(std::size_t mesh, double time) const {
  const MeshWall& m = scene_->grains.meshes[mesh];
  return m.begin <= time && (!m.end || time < *m.end);
}

double MeshWalls::longest_way(double from, double to) const {
  double longest = 0;
  for (std::size_t m = 0; m < count(); ++m)
    longest = std::max(longest, longest_path(scene_->grains.meshes[m].motion, from, to, arms_[m]));
  return 1.0001 * longest;
}

}  // namespace sph
