// [[mesh]]: a wall of triangles beside grains, and how it moves. Where it is follows from the time alone.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "sph/scene/prescribed_motion.hpp"

namespace sph {

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
  PrescribedMotion motion;
  friend bool operator==(const MeshWall&, const MeshWall&) = default;
};

}  // namespace sph
