// Sorts `lanes` columns of a matrix at once, ascending: Batcher's odd-even merge exchange (Knuth 5.2.2,
// algorithm M), whose sequence of comparisons depends on the length only, so every lane does the same.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

#include "sph/core/simd.hpp"

namespace sph {

template <int Lanes>
void sort_lanes(std::uint32_t* matrix, std::size_t rows) {
  constexpr std::size_t bytes = std::min(Lanes * 4, register_bytes), part = bytes / 4;
  typedef std::uint32_t Part __attribute__((vector_size(bytes)));
  if (rows < 2) return;
  const auto exchange = [matrix](std::size_t a, std::size_t b) {
    for (std::size_t lane = 0; lane < Lanes; lane += part) {
      Part x, y;
      std::memcpy(&x, matrix + a * Lanes + lane, sizeof x);
      std::memcpy(&y, matrix + b * Lanes + lane, sizeof y);
      const Part low = x < y ? x : y;
      const Part high = x < y ? y : x;
      std::memcpy(matrix + a * Lanes + lane, &low, sizeof low);
      std::memcpy(matrix + b * Lanes + lane, &high, sizeof high);
    }
  };
  const std::size_t top = std::bit_ceil(rows) / 2;
  for (std::size_t p = top; p > 0; p /= 2) {
    std::size_t q = top, r = 0, d = p;
    while (true) {
      for (std::size_t i = 0; i + d < rows; ++i)
        if ((i & p) == r) exchange(i, i + d);
      if (q == p) break;
      d = q - p;
      q /= 2;
      r = p;
    }
  }
}

}  // namespace sph
