// [[mesh]]: a wall of triangles beside grains, and how it moves: as it is told, so that where it is follows from the time alone; or along
// a direction as the grains let it, so that its way is state (WallState).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "sph/scene/prescribed_motion.hpp"

namespace sph {

/// Along a direction: a servo, which seeks a speed, or a mass, which falls.
struct MeshDrive {
  std::optional<double> force;  ///< along the direction [N]: a servo presses with it, a mass is pushed by it
  double servo_gain = 0;        ///< speed per excess of force [m/s/N]; 0: no servo
  double mass = 0;              ///< [kg]; 0: none
  double largest_speed = 0;     ///< it goes no faster [m/s]
  [[nodiscard]] bool any() const { return servo_gain > 0 || mass > 0; }
  friend bool operator==(const MeshDrive&, const MeshDrive&) = default;
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
  PrescribedMotion motion;         ///< of one that is driven the direction alone
  MeshDrive drive;
  friend bool operator==(const MeshWall&, const MeshWall&) = default;
};

}  // namespace sph
