// How stiff the contacts of each grain are where it is now, normally and tangentially, added up over them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sph/models/contact_table.hpp"
#include "sph/pairs/contact_lists.hpp"

namespace sph {

/// Of each row [`unit` N/m], integers, so that no order counts. Halo copies are up to date; sums of theirs are not whole.
[[nodiscard]] std::vector<std::array<std::int64_t, 2>> stiffness_of_rows(
    const Scene& scene, const ContactLists& lists, const Particles& grains, const ContactTable& table,
    std::span<const PlaneNow> planes, double quantum, double unit);

}  // namespace sph
