// What a run says of the walls of grains and of rigid bodies: their place, how they move, what acts on them. Every rank has all
// of it without a message.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "sph/step/simulation.hpp"

namespace sph {

/// Place [m], velocity [m/s] and force of the grains [N].
[[nodiscard]] std::array<double, 9> values_of_wall(const Simulation& simulation, int wall);

[[nodiscard]] std::vector<std::string> names_of_body(int dim);
[[nodiscard]] std::vector<double> values_of_body(const Simulation& simulation, int group);

}  // namespace sph
