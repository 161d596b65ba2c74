// How a scene says that something moves, whatever acts on it: a mesh beside grains, a rigid body in a fluid.
#pragma once

#include <array>

#include "sph/scene/time_curve.hpp"

namespace sph {

/// x(t) = centre + R(angle) (x_0 - centre) + way, with angle the integral of spin and way that of speed along direction, and
/// amplitude sin(2 pi frequency t).
struct PrescribedMotion {
  std::array<double, 3> direction{1, 0, 0};  ///< unit vector
  TimeCurve speed;                           ///< along it [m/s]; empty: none
  std::array<double, 3> amplitude{};         ///< [m]
  double frequency = 0;                      ///< [1/s]
  std::array<double, 3> centre{};            ///< a point of the axis [m]
  std::array<double, 3> axis{0, 0, 1};       ///< unit vector
  TimeCurve spin;                            ///< about it [rad/s]; empty: none
  friend bool operator==(const PrescribedMotion&, const PrescribedMotion&) = default;
};

/// Where it is then.
struct MotionNow {
  std::array<double, 3> way, velocity;  ///< of the centre [m], [m/s]
  double angle, spin;                   ///< about the axis [rad], [rad/s]
};
[[nodiscard]] MotionNow motion_at(const PrescribedMotion& motion, double time);
/// Bound on the path between two times of what is `radius` from the axis [m].
[[nodiscard]] double longest_path(const PrescribedMotion& motion, double from, double to, double radius);

/// Steps that still follow its oscillation [s].
[[nodiscard]] double longest_step_of(const PrescribedMotion& motion);

}  // namespace sph
