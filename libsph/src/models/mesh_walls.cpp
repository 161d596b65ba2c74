#include "sph/models/mesh_walls.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sph/core/exact_math.hpp"
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

double integral(const TimeCurve& curve, double time) { return curve.empty() ? 0 : integral_of(curve, time); }

}  // namespace

MeshWalls::MeshWalls(const decomp::Comm& comm, const Scene& scene, const PositionScale& scale)
    : scene_(&scene), scale_(scale), surfaces_(read_surfaces(comm, scene)) {}

std::size_t MeshWalls::bytes() const {
  std::size_t sum = 0;
  for (const auto& surface : surfaces_) sum += surface->bytes();
  return sum;
}

std::vector<MeshNow> MeshWalls::now(double time) const {
  std::vector<MeshNow> out;
  for (std::size_t m = 0; m < count(); ++m) {
    const MeshWall& mesh = scene_->grains.meshes[m];
    const MeshMotion& motion = mesh.motion;
    const double phase = 2 * std::numbers::pi * motion.frequency, swing = exact_sin(phase * time),
                 swinging = phase * exact_cos(phase * time), along = integral(motion.speed, time),
                 speed = motion.speed.empty() ? 0 : value_at(motion.speed, time),
                 spin = motion.spin.empty() ? 0 : value_at(motion.spin, time);
    MeshNow place{};
    place.surface = surfaces_[m].get();
    for (std::size_t a = 0; a < 3; ++a) {
      place.centre[a] = scale_.quanta(motion.centre[a]);
      place.way[a] = along * motion.direction[a] + swing * motion.amplitude[a];
      place.velocity[a] = speed * motion.direction[a] + swinging * motion.amplitude[a];
      place.spin[a] = spin * motion.axis[a];
    }
    place.rotation = rotation_of(motion.axis, integral(motion.spin, time));
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
  for (std::size_t m = 0; m < count(); ++m) {
    const MeshMotion& motion = scene_->grains.meshes[m].motion;
    double swing = 0;
    for (const double a : motion.amplitude) swing += a * a;
    const double phase = 2 * std::numbers::pi * motion.frequency;
    longest =
        std::max(longest, peak_between(motion.speed, from, to) * (to - from) +
                              std::sqrt(swing) * std::min(phase * (to - from), 2.0) +
                              surfaces_[m]->radius() * (peak_between(motion.spin, from, to) * (to - from)));
  }
  return 1.0001 * longest;
}

}  // namespace sph
