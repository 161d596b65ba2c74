#include "output/wall_values.hpp"

namespace sph {

std::array<double, 9> values_of_wall(const Simulation& s, int wall) {
  const auto w = static_cast<std::size_t>(wall);
  const WallsNow walls = s.grains()->walls().now(s.global());
  const WallState& state = s.global().walls[w];
  std::array<double, 9> out{};
  for (std::size_t a = 0; a < 3; ++a) {
    if (w < walls.planes.size()) {
      out[a] = s.scale().metres(walls.planes[w].point[a]);
      out[3 + a] = state.velocity[a];
    } else {
      const MeshNow& mesh = walls.meshes[w - walls.planes.size()];
      out[a] = s.scale().metres(mesh.centre[a]) + mesh.way[a];
      out[3 + a] = mesh.velocity[a];
    }
    out[6 + a] = s.grains()->walls().newton(state.force[a]);
  }
  return out;
}

std::vector<std::string> names_of_body(int dim) {
  if (dim == 2) return {"x", "y", "vx", "vy", "angle", "w", "fx", "fy", "torque"};
  return {"x",  "y",  "z",  "vx", "vy", "vz", "qw", "qx", "qy", "qz",
          "wx", "wy", "wz", "fx", "fy", "fz", "tx", "ty", "tz"};
}

std::vector<double> values_of_body(const Simulation& s, int group) {
  const auto index = rigid_bodies_of(s.scene())[static_cast<std::size_t>(group)];
  const BodyState& body = s.global().bodies[static_cast<std::size_t>(index)];
  const int dim = s.scene().dim;
  const auto d = static_cast<std::size_t>(dim);
  std::vector<double> out;
  const auto add = [&](const std::array<double, 3>& x) { out.insert(out.end(), x.begin(), x.begin() + dim); };
  std::array<double, 3> place{}, force = body.load.force;
  for (std::size_t a = 0; a < d; ++a) {
    place[a] = s.scale().metres(s.wrap()(static_cast<int>(a), body.motion.centre[a]));
    force[a] -= body.shape.heaviness * s.scene().domain.gravity[a];
  }
  add(place);
  add(body.motion.velocity);
  if (dim == 2) {
    out.insert(out.end(), {body.motion.angle, body.motion.spin[2]});
    add(force);
    out.push_back(body.load.torque[2]);
    return out;
  }
  out.insert(out.end(), body.motion.turn.begin(), body.motion.turn.end());
  add(body.motion.spin);
  add(force);
  add(body.load.torque);
  return out;
}

}  // namespace sph
