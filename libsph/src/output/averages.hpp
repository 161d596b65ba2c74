// Averages that the paper suggests against noise, as extra columns of snapshots; the state never sees them.
//   space  velocity_smooth, pressure_smooth:  a_i = sum_j V_j W_ij a_j / sum_j V_j W_ij  over the particle
//          itself and its neighbours of the same group, in ascending id: the same bits on any number of ranks
// The running averages in time are fields of their own (velocity_mean, pressure_mean).
#pragma once

#include <vector>

#include "sph/output/snapshot.hpp"
#include "sph/step/simulation.hpp"

namespace sph {

/// The columns without values.
[[nodiscard]] std::vector<ExtraColumn> average_columns(const Scene& scene);
/// Collective: refreshes halo copies.
[[nodiscard]] std::vector<ExtraColumn> averages(Simulation& simulation);

}  // namespace sph
