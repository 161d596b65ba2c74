// Rows of a file in an order that does not depend on ranks.
#pragma once

#include <cstdint>

#include "decomp/comm.hpp"
#include "decomp/table.hpp"

namespace sph {

/// Sorts by the first column, then, with `keys` = 2, by the second, both 8-byte ids: rank r gets the r-th of
/// equal ranges of the first. Collective.
void sort_by_id(const decomp::Comm& comm, decomp::Table& table, int keys);

/// Rank r gets the r-th of equal shares of the rows, in the order that they have over all ranks; each is of whole
/// `unit`s, but for the last. Collective.
void share_out(const decomp::Comm& comm, decomp::Table& table, std::int64_t unit);

}  // namespace sph
