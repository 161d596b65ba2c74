// A liquid of a weakly compressible scheme must be stiff enough: c at least ten times the largest speed to
// expect, the larger of those at the start and sqrt(g H), or its density varies by more than a percent. And
// what begins faster than sound is nearly always a unit gone wrong.
#pragma once

#include <string>
#include <vector>

#include "sph/scene/scene.hpp"
#include "start/start_count.hpp"

namespace sph {

/// Lines "warning: ...", for `check`. `heights` by group; `file_speed`: largest of the rows of a start file
/// [m/s].
[[nodiscard]] std::string speed_warnings(const Scene& scene, const std::vector<Height>& heights,
                                         double file_speed);

}  // namespace sph
