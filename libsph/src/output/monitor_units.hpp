// The units of the columns of series.csv. What is of matter is per metre of depth in 2D.
#pragma once

#include <string>
#include <string_view>

#include "sph/scene/run_scene.hpp"

namespace sph {

/// "" of numbers. Throws std::logic_error for a quantity that has none.
[[nodiscard]] std::string unit_of(MonitorKind kind, std::string_view quantity, int dim);

}  // namespace sph
