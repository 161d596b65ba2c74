// A key whose value follows time: a number, or [[time, number], ...].
#pragma once

#include <optional>
#include <string_view>

#include "keys/key_value.hpp"
#include "sph/scene/time_curve.hpp"

namespace sph {

class SceneWriter;

/// Empty where it is not given.
[[nodiscard]] TimeCurve read_curve(const std::optional<KeyValue>& value, Dimension dim);
/// Nothing where it is empty.
void write_curve(SceneWriter& out, std::string_view key, const TimeCurve& curve);

}  // namespace sph
