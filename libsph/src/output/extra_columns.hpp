// What snapshots show beyond the fields of the particles; the state never sees it.
//   average_space  averages.hpp
//   contacts       of grains: stress [Pa], xx, yy, zz, xy, yz, xz, the symmetric part of
//                  1/V sum_c f_c (x) l_c over the contacts of the grain (Love 1927; Weber 1966), f the force
//                  on the grain, l from its centre to the point of contact, V its own volume: compression is
//                  negative. coordination: the number of those contacts, walls and fixed grains included.
//                  The terms are rounded to quanta of torque and added as integers: no order, no ranks
#pragma once

#include <vector>

#include "sph/output/snapshot.hpp"
#include "sph/step/simulation.hpp"

namespace sph {

/// The columns without values.
[[nodiscard]] std::vector<ExtraColumn> extra_columns(const Scene& scene);
/// With values. Collective: refreshes halo copies, and may move rows where contacts are asked for.
[[nodiscard]] std::vector<ExtraColumn> extra_columns(Simulation& simulation);

/// The contacts that this rank counts. After extra_columns().
[[nodiscard]] ContactColumns contact_columns(const Simulation& simulation);

}  // namespace sph
