#include "sph/models/rigid_motion.hpp"

#include <Eigen/LU>
#include <cmath>

#include "sph/core/exact_math.hpp"

namespace sph {
namespace {

using Turn = std::array<double, 4>;

Turn product(const Turn& a, const Turn& b) {
  return {a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
          a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
          a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
          a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]};
}

Turn unit(const Turn& a) {
  const double length = std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2] + a[3] * a[3]);
  return {a[0] / length, a[1] / length, a[2] / length, a[3] / length};
}

/// Cayley's rotation by the vector w: (1 - [w]/2)^-1 (1 + [w]/2).
Turn cayley(const Vector3& w) { return unit({1, 0.5 * w[0], 0.5 * w[1], 0.5 * w[2]}); }

/// Angular velocity in the body's frame that holds for the step.
Vector3 midpoint_spin(const BodyState& body, double dt) {
  const Matrix3 inverse = inertia_of(body.shape).inverse();
  const Vector3 before = rotation_of(body.motion.turn).transpose() * vector_of(body.motion.angular_momentum);
  Vector3 spin = inverse * before;
  constexpr int most = 60;  // each repetition leaves omega dt of what is missing
  for (int k = 0; k < most; ++k) {
    const Vector3 after = rotation_of(cayley(-dt * spin)) * before;
    const Vector3 better = inverse * (0.5 * (before + after));
    if (better == spin) break;
    spin = better;
  }
  return spin;
}

}  // namespace

Matrix3 rotation_of(const Turn& q) {
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  Matrix3 r;
  r << 1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),  //
      2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),   //
      2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y);
  return r;
}

Matrix3 inertia_of(const BodyShape& shape) {
  const std::array<double, 6>& i = shape.inertia;
  Matrix3 m;
  m << i[0], i[3], i[4], i[3], i[1], i[5], i[4], i[5], i[2];
  return m;
}

Turning turning(const BodyState& body, int dim, bool held, double dt) {
  const BodyMotion& now = body.motion;
  if (dim == 2) {
    const double spin = now.spin[2];
    const auto at = [](double angle) { return Turn{exact_cos(0.5 * angle), 0, 0, exact_sin(0.5 * angle)}; };
    return {{0, 0, spin}, at(now.angle + 0.5 * dt * spin), at(now.angle + dt * spin), now.angle + dt * spin};
  }
  Turning out{vector_of(now.spin), {}, {}, 0};
  if (held) {
    out.whole = unit(product(cayley(dt * out.spin), now.turn));
  } else {
    const Vector3 spin = midpoint_spin(body, dt);
    out.spin = rotation_of(now.turn) * spin;
    out.whole = unit(product(now.turn, cayley(dt * spin)));
  }
  for (std::size_t k = 0; k < 4; ++k) out.half[k] = now.turn[k] + out.whole[k];
  out.half = unit(out.half);
  return out;
}

namespace {

/// About a unit vector.
Turn turn_about(const std::array<double, 3>& axis, double angle) {
  const double s = exact_sin(0.5 * angle);
  return {exact_cos(0.5 * angle), s * axis[0], s * axis[1], s * axis[2]};
}

}  // namespace

Vector3 from_axis(const BodyState& body, const PrescribedMotion& motion, const Lengths& lengths,
                  double time) {
  const MotionNow now = motion_at(motion, time);
  Vector3 r;
  for (std::size_t a = 0; a < 3; ++a) {
    double x = lengths.scale.metres(body.motion.centre[a]) - (motion.centre[a] + now.way[a]);
    if (const double period = lengths.scale.metres(lengths.wrap.period[a]); period > 0)
      x -= period * std::nearbyint(x / period);
    r[static_cast<Eigen::Index>(a)] = x;
  }
  return r;
}

Turning lead(BodyState& body, const PrescribedMotion& motion, const Lengths& lengths, int dim, double time,
             double dt) {
  const MotionNow from = motion_at(motion, time), to = motion_at(motion, time + dt);
  const double angle = to.angle - from.angle;
  const Vector3 r = from_axis(body, motion, lengths, time), way = vector_of(to.way) - vector_of(from.way),
                round = rotation_of(turn_about(motion.axis, angle)) * r - r;
  body.motion.velocity = array_of((way + round) / dt);
  body.motion.spin = array_of((angle / dt) * vector_of(motion.axis));
  if (dim == 2) return turning(body, dim, true, dt);
  const Turn& now = body.motion.turn;
  return {vector_of(body.motion.spin), unit(product(turn_about(motion.axis, 0.5 * angle), now)),
          unit(product(turn_about(motion.axis, angle), now)), 0};
}

void take_speed(BodyState& body, const PrescribedMotion& motion, const Lengths& lengths, double time,
                double at) {
  const MotionNow then = motion_at(motion, at);
  const double angle = then.angle - motion_at(motion, time).angle;
  const Vector3 r = rotation_of(turn_about(motion.axis, angle)) * from_axis(body, motion, lengths, time),
                spin = then.spin * vector_of(motion.axis);
  body.motion.spin = array_of(spin);
  body.motion.velocity = array_of(vector_of(then.velocity) + spin.cross(r));
}

void settle_spin(BodyState& body, bool held) {
  BodyMotion& now = body.motion;
  const Matrix3 r = rotation_of(now.turn), inertia = inertia_of(body.shape);
  if (held)
    now.angular_momentum = array_of(r * (inertia * (r.transpose() * vector_of(now.spin))));
  else
    now.spin = array_of(r * (inertia.inverse() * (r.transpose() * vector_of(now.angular_momentum))));
}

// The margin covers the rounding to quanta.
double longest_path(const BodyState& body, int dim, bool held, double dt) {
  return 1.0001 * dt *
         (vector_of(body.motion.velocity).norm() +
          turning(body, dim, held, dt).spin.norm() * body.shape.radius);
}

double longest_path(const BodyState& body, const PrescribedMotion& motion, const Lengths& lengths,
                    double time, double dt) {
  // From the axis it is as far at all times; where there is none the distance does not count.
  const double away = motion.spin.empty() ? 0 : from_axis(body, motion, lengths, time).norm();
  return 1.0001 * longest_path(motion, time, time + dt, away + body.shape.radius);
}

}  // namespace sph
