// Grains in a tank of fluid of periodic sides, on a floor, under a free surface or a lid: what its tests share. Spacings
// of 1 m, g = 1 m/s^2, c = 50 m/s, rho = 1000 kg/m^3; the fluid is set 0, the grains are set 1.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "measure.hpp"

namespace tank {

struct Tank {
  double width, depth, viscosity;
  std::string grain, fill;  ///< keys of their group and of their lattice
  double h_over_dx = 1.2, jitter = 0, stiffness = 1e4;
  bool lid = false;
  std::string law = "stokes", more{};
};

inline const decomp::Comm& self() {
  static const decomp::Comm comm(MPI_COMM_SELF);
  return comm;
}

inline sph::Scene scene_of(const Tank& tank, const std::vector<std::string>& options = {}) {
  const std::string air = R"(
[[start.region]]
group = "none"
shape = "box"
lower = [0, 0, 0]
upper = [{0}, {0}, {1}])";
  const std::string text = fmt::format(
      R"(
[domain]
lower = [0, 0, -4]
upper = [{0}, {0}, {1}]
periodic = [true, true, false]
gravity = [0, 0, -1]
[kernel]
h_over_dx = {2}
[contact]
law = "linear"
[drag]
law = "{3}"
[[group]]
name = "water"
kind = "fluid"
density = 1000
sound_speed = 50
viscosity = {4}
[[group]]
name = "wall"
kind = "wall"
[[group]]
name = "grains"
kind = "grain"
normal_stiffness = {5}
restitution = 0.5
{6}
[start]
spacing = 1
jitter = {7}
upper = [{0}, {0}, {1}]
pressure = "hydrostatic"
surface_height = {8}
[[start.region]]
group = "wall"
{9}
[[start.region]]
group = "water"
shape = "box"
lower = [0, 0, 0]
upper = [{0}, {0}, {8}]
[[start.grains]]
group = "grains"
{10}
[time]
steps = 1
{11}
)",
      tank.width, tank.depth + 4, tank.h_over_dx, tank.law, tank.viscosity, tank.stiffness, tank.grain,
      tank.jitter, tank.depth, tank.lid ? "" : fmt::format(fmt::runtime(air), tank.width, tank.depth + 4),
      tank.fill, tank.more);
  return sph::parse_scene(text, "tank", options);
}

inline sph::Simulation filled(const Tank& tank, const std::vector<std::string>& options = {}) {
  return {self(), scene_of(tank, options)};
}

inline void go_on(sph::Simulation& s, double until) {
  while (s.global().time < until) s.step();
}

/// Of the particles of a set between two heights that are not wall.
template <class Value>
double mean(const sph::Simulation& s, std::size_t set, double low, double high, Value value) {
  const sph::Particles& p = s.particles(set);
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < p.owned(); ++i) {
    const double z = s.scale().metres(p.data<sph::Field::position>()[i * 3 + 2]);
    if (z < low || z > high || (set == 0 && p.data<sph::Field::group>()[i] != 0)) continue;
    sum += value(i, z);
    count += 1;
  }
  return sum / count;
}

inline double mean_height(const sph::Simulation& s, std::size_t set) {
  return mean(s, set, -1e9, 1e9, [](std::size_t, double z) { return z; });
}

/// Mean velocity along z.
inline double rising(const sph::Simulation& s, std::size_t set, double low, double high) {
  const double* v = s.particles(set).data<sph::Field::velocity>();
  return mean(s, set, low, high, [v](std::size_t i, double) { return v[i * 3 + 2]; });
}

}  // namespace tank
