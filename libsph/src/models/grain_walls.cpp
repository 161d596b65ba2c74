#include "sph/models/grain_walls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sph/core/error.hpp"
#include "sph/core/findings.hpp"
#include "sph/core/fixed_point.hpp"

namespace sph {
namespace {

/// Grains are within 2^60 quanta of the origin, and their distances from a wall within 2^63 [quanta].
constexpr double farthest = 0x1p62;

}  // namespace

GrainWalls::GrainWalls(const decomp::Comm& comm, const Scene& scene, const PositionScale& scale,
                       double force_quantum)
    : scene_(&scene), scale_(scale), force_quantum_(force_quantum), meshes_(comm, scene, scale) {
  for (std::size_t w = 0; w < count(); ++w)
    for (const double x : began(w))
      if (!(std::fabs(x) / scale_.quantum < farthest))
        throw InputError(
            fmt::format("{}: {} \"{}\": {} has a coordinate of {:.6g} m, so far away that distances are no "
                        "numbers; be nearer than {:.4g} m",
                        scene.file, w < planes() ? "wall" : "mesh", scene.grains.names()[w],
                        w < planes() ? "point" : "centre", x, farthest * scale_.quantum));
}

void GrainWalls::start(GlobalState& global) const {
  global.walls.resize(count());
  for (std::size_t w = 0; w < planes(); ++w) global.walls[w].velocity = scene_->grains.walls[w].velocity;
}

GrainWalls::Now GrainWalls::now_of(std::size_t wall, const GlobalState& global) const {
  const Wall& w = scene_->grains.walls[wall];
  Now now{true, w.velocity, w.force};
  for (const WallStage& s : scene_->grains.stages) {
    if (s.begin > global.time) break;
    for (const WallChange& c : s.walls) {
      if (c.wall != static_cast<int>(wall)) continue;
      now.present = now.present && !c.remove;
      if (c.velocity) now.velocity = *c.velocity, now.force.reset();
      if (c.force) now.force = c.force;
    }
  }
  return now;
}

bool GrainWalls::present(std::uint64_t key, const GlobalState& global) const {
  const WallName name(key);
  return name.is_facet() ? meshes_.present(name.wall, global.time) : now_of(name.wall, global).present;
}

void GrainWalls::set_stage(GlobalState& global) const {
  for (std::size_t w = 0; w < planes(); ++w) {
    const Now now = now_of(w, global);
    if (!now.force) global.walls[w].velocity = now.velocity;
  }
}

WallsNow GrainWalls::now(const GlobalState& global) const {
  WallsNow out{{}, meshes_.now(global.time, std::span(global.walls).subspan(planes()))};
  for (std::size_t w = 0; w < planes(); ++w) {
    const Wall& wall = scene_->grains.walls[w];
    PlaneNow plane{{},
                   wall.normal,
                   global.walls[w].velocity,
                   static_cast<std::uint32_t>(wall.group),
                   now_of(w, global).present};
    for (std::size_t a = 0; a < 3; ++a)
      plane.point[a] = scale_.quanta(wall.point[a]) + global.walls[w].offset[a];
    out.planes.push_back(plane);
  }
  return out;
}

// A tangential velocity drags the grains; the plane itself moves along its normal only, a mesh along its direction.
void GrainWalls::move(GlobalState& global) const {
  for (std::size_t w = 0; w < count(); ++w) {
    WallState& state = global.walls[w];
    const Double3& normal =
        w < planes() ? scene_->grains.walls[w].normal : scene_->grains.meshes[w - planes()].motion.direction;
    double along = 0;
    for (std::size_t a = 0; a < 3; ++a) along += state.velocity[a] * normal[a];
    for (std::size_t a = 0; a < 3; ++a) {
      const std::int64_t way = round_to_quanta(along * normal[a] * global.dt / scale_.quantum);
      const double place = began(w)[a] / scale_.quantum + static_cast<double>(state.offset[a] + way);
      if (std::fabs(place) < farthest)
        state.offset[a] += way;
      else if (w < planes() ? now_of(w, global).present : meshes_.present(w - planes(), global.time))
        throw GuardError(fmt::format(
            "{}wall \"{}\" is at {} = {:.4g} m, so far away that distances are no numbers; stop it before",
            step_text(global.step), scene_->grains.names()[w], "xyz"[a], place * scale_.quantum));
    }
  }
}

void GrainWalls::push(GlobalState& global, std::span<const std::int64_t> forces) const {
  for (std::size_t w = 0; w < count(); ++w) {
    WallState& state = global.walls[w];
    for (std::size_t a = 0; a < 3; ++a) state.force[a] = forces[3 * w + a];
    if (w >= planes()) {
      drive(w - planes(), global);
      continue;
    }
    const Wall& wall = scene_->grains.walls[w];
    double pressed = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      pressed -= newton(state.force[a]) * wall.normal[a];
    }
    const Now now = now_of(w, global);
    if (!now.force || !now.present) continue;
    const double wanted = wall.servo_gain * (*now.force - pressed);
    const double speed = std::clamp(wanted, -wall.largest_speed, wall.largest_speed);
    for (std::size_t a = 0; a < 3; ++a) state.velocity[a] = speed * wall.normal[a];
  }
}

void GrainWalls::drive(std::size_t mesh, GlobalState& global) const {
  const MeshWall& m = scene_->grains.meshes[mesh];
  if (!m.drive.any()) return;
  WallState& state = global.walls[planes() + mesh];
  double force = m.drive.force.value_or(0), speed = 0, weight = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    force += newton(state.force[a]) * m.motion.direction[a];
    speed += state.velocity[a] * m.motion.direction[a];
    weight += m.drive.mass * scene_->domain.gravity[a] * m.motion.direction[a];
  }
  if (!meshes_.present(mesh, global.time))
    speed = 0;
  else if (m.drive.mass > 0)
    speed += (force + weight) / m.drive.mass * global.dt;
  else
    speed = m.drive.servo_gain * force;
  speed = std::clamp(speed, -m.drive.largest_speed, m.drive.largest_speed);
  for (std::size_t a = 0; a < 3; ++a) state.velocity[a] = speed * m.motion.direction[a];
}

// A stage that begins now has told nobody its velocities yet.
double GrainWalls::longest_way(const GlobalState& global) const {
  double speed2 = 0;
  const auto look = [&](const Double3& v) {
    speed2 = std::max(speed2, v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  };
  for (const WallState& w : global.walls) look(w.velocity);
  for (std::size_t w = 0; w < planes(); ++w) look(now_of(w, global).velocity);
  return std::max(1.0001 * std::sqrt(speed2) * global.dt,
                  meshes_.longest_way(global.time, global.time + global.dt));
}

std::vector<std::int64_t> GrainWalls::forces(std::span<const std::int64_t> halves,
                                             const GlobalState& global) const {
  const std::size_t n = halves.size() / 2;
  std::vector<std::int64_t> forces(n);
  for (std::size_t k = 0; k < n; ++k) {
    const std::int64_t high = halves[n + k] + (halves[k] >> 32);
    if (high >= std::int64_t{1} << 30 || high < -(std::int64_t{1} << 30))
      throw GuardError(fmt::format(
          "{}the force on wall \"{}\", {:.6g} N along {}, is beyond the range of the sums, {:.6g} N; reduce "
          "time.dt, or what presses on it",
          step_text(global.step), scene_->grains.names()[k / 3],
          std::ldexp(static_cast<double>(high), 32) * force_quantum_, "xyz"[k % 3], 0x1p62 * force_quantum_));
    forces[k] = high * (std::int64_t{1} << 32) + (halves[k] & 0xffffffff);
  }
  return forces;
}

}  // namespace sph
