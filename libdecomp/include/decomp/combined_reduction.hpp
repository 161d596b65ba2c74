// Maxima and sums of integers over all ranks in one message, where two would double the latency of a step.
// The maxima are exact in any order of the ranks, as those of Comm are: -0 < +0, and a NaN anywhere is the
// result. Sums of integers depend on no order at all.
#pragma once

#include <cstdint>
#include <span>

#include "decomp/comm.hpp"

namespace decomp {

/// In place, all ranks get the result. Collective.
void max_and_sum(const Comm& comm, std::span<double> maxima, std::span<std::int64_t> sums);

}  // namespace decomp
