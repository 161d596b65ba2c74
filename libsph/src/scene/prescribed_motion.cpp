#include "sph/scene/prescribed_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "sph/core/exact_math.hpp"

namespace sph {
namespace {

double integral(const TimeCurve& curve, double time) { return curve.empty() ? 0 : integral_of(curve, time); }
double value(const TimeCurve& curve, double time) { return curve.empty() ? 0 : value_at(curve, time); }

}  // namespace

MotionNow motion_at(const PrescribedMotion& motion, double time) {
  const double phase = 2 * std::numbers::pi * motion.frequency, swing = exact_sin(phase * time),
               swinging = phase * exact_cos(phase * time), along = integral(motion.speed, time),
               speed = value(motion.speed, time);
  MotionNow now{{}, {}, integral(motion.spin, time), value(motion.spin, time)};
  for (std::size_t a = 0; a < 3; ++a) {
    now.way[a] = along * motion.direction[a] + swing * motion.amplitude[a];
    now.velocity[a] = speed * motion.direction[a] + swinging * motion.amplitude[a];
  }
  return now;
}

double longest_path(const PrescribedMotion& motion, double from, double to, double radius) {
  double swing = 0;
  for (const double a : motion.amplitude) swing += a * a;
  const double phase = 2 * std::numbers::pi * motion.frequency;
  return peak_between(motion.speed, from, to) * (to - from) +
         std::sqrt(swing) * std::min(phase * (to - from), 2.0) +
         radius * (peak_between(motion.spin, from, to) * (to - from));
}

double longest_step_of(const PrescribedMotion& motion) {
  constexpr double steps = 20;  // of a period: its acceleration is then 1 % off
  return motion.frequency > 0 ? 1 / (steps * motion.frequency) : std::numeric_limits<double>::infinity();
}

}  // namespace sph
