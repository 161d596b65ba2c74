// [[mesh]]: a wall of triangles beside grains, and how it moves. Where it is follows from the time alone.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "sph/scene/time_curve.hpp"

namespace sph {

/// x(t) = centre + R(angle) (x_0 - centre) + way, with angle the integral of spin and way that of speed along direction, and
/// amplitude sin(2 pi frequency t).
struct MeshMotion {
  std::array<double, 3> direction{1, 0, 0};  ///< unit vector
  TimeCurve speed;                           ///< along it [m/s]; empty: none
  std::array<double, 3> amplitude{};         ///< [m]
  double frequency = 0;                      ///< [1/s]
  std::array<double, 3> centre{};            ///< a point of the axis [m]
  std::array<double, 3> axis{0, 0, 1};       ///< unit vector
  TimeCurve spin;                            ///< about it [rad/s]; empty: none
  friend bool operator==(const MeshMotion&, const MeshMotion&) = default;
};

struct MeshWall {
  std::string name;
  int group = 0;                   ///< material
  std::string file;                ///< STL or OBJ
  std::string content;             ///< hash of what was read when the run began; empty: not read yet
  double scale = 1;                ///< metres of a unit of the file
  std::array<double, 3> origin{};  ///< where the origin of the file is at the start [m]
  double smooth_angle = 20;        ///< between facets that a grain touches as one [degrees]
  double begin = 0;                ///< from then on it is there [s],
  std::optional<double> end;       ///< until then; without, to the end
  MeshMotion motion;
  friend bool operator==(const MeshWall&, const MeshWall&) = default;
};

}  // namespace sph
