// Cuts as chaos draws them, known in advance: for recordings, and for seeds that divide the particles.
#pragma once

#include <cstdint>
#include <filesystem>

#include "decomp/cut_policy.hpp"

namespace equivalence {

/// Chaos likes to leave everything to one rank, and with large lists it is not asked often: a seed from
/// `seed` on with which two of the first three cuts divide the domain, if there is one among `attempts`.
[[nodiscard]] std::uint64_t dividing_seed(const decomp::Cuts& start, std::uint64_t seed,
                                          std::uint64_t attempts = 1'000'000'000);

/// A recording of the first `count` cuts that chaos draws, for decomposition.replay.
void write_random_cuts(const std::filesystem::path& path, const decomp::Cuts& start, std::uint64_t seed,
                       std::int64_t count);

}  // namespace equivalence
