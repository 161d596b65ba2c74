// What [[mesh]] and [group.motion] share: keys of a motion as it is told.
#pragma once

#include <algorithm>
#include <optional>

#include "keys/scene_resolve.hpp"
#include "keys/scene_writer.hpp"
#include "keys/time_curve.hpp"
#include "sph/scene/prescribed_motion.hpp"

namespace sph {

/// Empty where it is 0 at all times.
[[nodiscard]] inline TimeCurve read_speed(const std::optional<KeyValue>& value, Dimension dim) {
  TimeCurve curve = read_curve(value, dim);
  if (std::ranges::all_of(curve, [](const auto& point) { return point[1] == 0; })) curve.clear();
  return curve;
}

/// What `table.read()` leaves of it. `driven`: it moves along the direction otherwise.
template <class Table>
void read_motion(const Table& table, PrescribedMotion& motion, bool driven = false) {
  using Name = typename Table::template Name<>;
  motion.speed = read_speed(table.value("velocity"), dimension::speed);
  motion.spin = read_speed(table.value("spin"), dimension::rate);
  const auto normalise = [&](Name key, Double3& of) {
    const std::optional<Double3> unit = unit_vector(of);
    if (!unit) table.fail(key, "has no direction", "give a vector of any length");
    of = *unit;
  };
  normalise("direction", motion.direction);
  normalise("axis", motion.axis);
  table.only_if(table.has("velocity") || driven, "direction", "it is of velocity, which is not given");
  table.only_if(table.has("spin"), "axis", "it is of spin, which is not given");
  table.only_if(table.has("spin"), "centre", "it is of spin, which is not given");
  if (table.has("amplitude") != table.has("frequency"))
    table.fail_missing(table.has("amplitude") ? Name("frequency") : Name("amplitude"),
                       "an oscillation has both");
}

/// So that direction and axis can be read back.
inline void write_motion(SceneWriter& out, const PrescribedMotion& motion) {
  write_curve(out, "velocity", motion.speed.empty() ? TimeCurve{{0, 0}} : motion.speed);
  write_curve(out, "spin", motion.spin.empty() ? TimeCurve{{0, 0}} : motion.spin);
}

}  // namespace sph
