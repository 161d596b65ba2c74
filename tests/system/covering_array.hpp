// Covering arrays. Of mixed strength: few rows in which every combination of levels of any three factors other
// than the scene occurs (ranks x cuts x restart, say), every pair of a scene with a level of any other factor, and
// every triple of a scene with two factors that have at most twelve combinations (precision x ranks, precision x
// cuts, overlap x ranks, list x restart, ...). A scene with all pairs of ranks, cuts, lists and restarts that have
// more (ranks x cuts: 36) take two and a half times the rows: those of strength three have them, and every triple.
// Greedy, one row at a time (AETG: Cohen, Dalal, Fredman, Patton, IEEE Trans. Softw. Eng. 23, 437, 1997).
#pragma once

#include <cstdint>
#include <vector>

#include "factors.hpp"

namespace equivalence {

enum class Strength : std::uint8_t { mixed, three };

/// No combination of levels is excluded: all scenes of a family exist in all its precisions and fit on all
/// rank counts.
[[nodiscard]] std::vector<Row> covering_array(Family family, std::uint64_t seed, Strength strength);

/// Number of combinations asked for that occur in no row, by plain enumeration; 0 for a covering array.
[[nodiscard]] std::size_t uncovered_triples(Family family, const std::vector<Row>& rows, Strength strength);

}  // namespace equivalence
