// Covering arrays of strength 3: few rows in which every combination of levels of any three factors occurs.
// Greedy, one row at a time (AETG: Cohen, Dalal, Fredman, Patton, IEEE Trans. Softw. Eng. 23, 437, 1997).
#pragma once

#include <cstdint>
#include <vector>

#include "factors.hpp"

namespace equivalence {

/// No combination of levels is excluded: all scenes of a family exist in all its precisions and fit on all
/// rank counts.
[[nodiscard]] std::vector<Row> covering_array(Family family, std::uint64_t seed);

/// Number of 3-way combinations that occur in no row, by plain enumeration; 0 for a covering array.
[[nodiscard]] std::size_t uncovered_triples(Family family, const std::vector<Row>& rows);

}  // namespace equivalence
