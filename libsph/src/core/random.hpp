// Random numbers that depend on what they are for, never on ranks or on the order in which they are drawn.
#pragma once

#include <cstdint>

namespace sph {

/// splitmix64 (Steele et al. 2014) as a counter-based generator: a hash of (seed, id, stream), stream 0 to 3.
[[nodiscard]] inline double uniform_minus_one_to_one(std::uint64_t seed, std::uint64_t id,
                                                     std::uint64_t stream) {
  std::uint64_t z = seed + 0x9e3779b97f4a7c15u * (id * 4 + stream + 1);
  for (int round = 0; round < 2; ++round) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    z ^= z >> 31;
  }
  return static_cast<double>(z >> 11) * 0x1p-52 - 1.0;
}

}  // namespace sph
