// Random numbers that depend on what they are for, never on ranks or on the order in which they are drawn.
#pragma once

#include <cstdint>

#include "decomp/splitmix.hpp"

namespace sph {

/// Of (seed, id, stream), stream 0 to 3.
[[nodiscard]] inline double uniform_minus_one_to_one(std::uint64_t seed, std::uint64_t id,
                                                     std::uint64_t stream) {
  const std::uint64_t state = seed + decomp::splitmix_stride * (id * 4 + stream + 1);
  return 2 * decomp::splitmix_unit(decomp::splitmix_mix(decomp::splitmix_mix(state))) - 1.0;
}

}  // namespace sph
