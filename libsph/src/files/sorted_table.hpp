// Rows of a file in an order that does not depend on ranks.
#pragma once

#include "decomp/comm.hpp"
#include "decomp/table.hpp"

namespace sph {

/// Sorts by the first column, then, with `keys` = 2, by the second, both 8-byte ids: rank r gets the r-th of
/// equal ranges of the first. Collective.
void sort_by_id(const decomp::Comm& comm, decomp::Table& table, int keys);

}  // namespace sph
