// How a rigid body moves: x = c + R a, v = V + omega x (x - c), with a the arm of a particle from the centre of mass at
// the start, R the rotation since. The body has angular momentum L about its centre, omega = R I^-1 R^T L (I the inertia
// at the start). In a step R turns by the implicit midpoint rule for L in the body's frame, l' = l + dt (l + l')/2 x omega
// (Austin, Krishnaprasad & Wang 1993), whose rotation is Cayley's: where no torque acts L does not change at all and
// the energy only by rounding. In 2D the angle is exact. A body that moves as it is told (PrescribedMotion) is where that
// has it at the end of each step, but for the rounding of its place.
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "sph/core/particles.hpp"
#include "sph/scene/prescribed_motion.hpp"

namespace sph {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;

[[nodiscard]] inline Vector3 vector_of(const std::array<double, 3>& x) { return {x[0], x[1], x[2]}; }
[[nodiscard]] inline std::array<double, 3> array_of(const Vector3& x) { return {x[0], x[1], x[2]}; }

/// R of a unit quaternion.
[[nodiscard]] Matrix3 rotation_of(const std::array<double, 4>& turn);
/// I of a symmetric tensor xx yy zz xy xz yz.
[[nodiscard]] Matrix3 inertia_of(const BodyShape& shape);

/// What turns in a step: the angular velocity that holds throughout, and the turns half a step on and at its end.
struct Turning {
  Vector3 spin;  ///< [rad/s], in the frame of the scene
  std::array<double, 4> half, whole;
  double angle;  ///< of a body in 2D
};
/// `held`: the angular velocity stays, not the momentum.
[[nodiscard]] Turning turning(const BodyState& body, int dim, bool held, double dt);

/// The lengths of a scene.
struct Lengths {
  PositionScale scale;
  Wrap wrap;
};
/// The same of a body that moves as it is told from `time` on; its velocity and spin are then what takes it through the
/// step.
[[nodiscard]] Turning lead(BodyState& body, const PrescribedMotion& motion, const Lengths& lengths, int dim,
                           double time, double dt);
/// How fast a body that is in its place at `time` is told to move at another time [m/s], [rad/s].
void take_speed(BodyState& body, const PrescribedMotion& motion, const Lengths& lengths, double time,
                double at);
/// From the axis to the centre of mass, over periods the nearest [m].
[[nodiscard]] Vector3 from_axis(const BodyState& body, const PrescribedMotion& motion, const Lengths& lengths,
                                double time);

/// Sets the spin from the angular momentum, or where that is held the momentum from the spin.
void settle_spin(BodyState& body, bool held);

/// Bound on the path of any particle of the body in a step [m].
[[nodiscard]] double longest_path(const BodyState& body, int dim, bool held, double dt);
[[nodiscard]] double longest_path(const BodyState& body, const PrescribedMotion& motion,
                                  const Lengths& lengths, double time, double dt);

}  // namespace sph
