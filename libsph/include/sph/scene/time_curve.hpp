// A value that a scene gives as a function of time.
#pragma once

#include <array>
#include <vector>

namespace sph {

/// Straight between points, before the first and after the last as there.
using TimeCurve = std::vector<std::array<double, 2>>;  ///< t [s], value; t ascends
[[nodiscard]] double value_at(const TimeCurve& curve, double time);
/// From 0 to `time`, at least 0.
[[nodiscard]] double integral_of(const TimeCurve& curve, double time);
/// The largest magnitude between two times; 0 of an empty curve.
[[nodiscard]] double peak_between(const TimeCurve& curve, double from, double to);

}  // namespace sph
