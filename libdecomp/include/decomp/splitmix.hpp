// SplitMix64 (Steele, Lea & Flood 2014): random numbers that are a hash of a counter, so that they depend on what
// they are for and on nothing else. The bits are part of what scenes begin with.
#pragma once

#include <cstdint>

namespace decomp {

/// From one number of a sequence to the next, before they are mixed.
inline constexpr std::uint64_t splitmix_stride = 0x9e3779b97f4a7c15U;

/// A bijection of 64 bits; 0 stays 0.
[[nodiscard]] constexpr std::uint64_t splitmix_mix(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31);
}

/// The number that follows the state x: another bijection.
[[nodiscard]] constexpr std::uint64_t splitmix(std::uint64_t x) { return splitmix_mix(x + splitmix_stride); }

/// In [0, 1), of the upper 53 bits.
[[nodiscard]] constexpr double splitmix_unit(std::uint64_t bits) {
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

}  // namespace decomp
