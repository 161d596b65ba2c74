// The order of a rank's rows by global id as 32-bit ranks: what lists are sorted by. Radix sort, 11 bits a
// pass, as many passes as the spread of the ids needs.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace sph {

struct IdRank {
  std::vector<std::uint32_t> row_of_rank, rank_of_row;

  IdRank(const std::uint64_t* ids, std::size_t rows) : row_of_rank(rows), rank_of_row(rows) {
    if (rows == 0) return;
    const auto [least, greatest] = std::minmax_element(ids, ids + rows);
    const std::uint64_t lowest = *least, spread = *greatest - *least;
    std::iota(row_of_rank.begin(), row_of_rank.end(), 0u);
    constexpr int bits = 11;
    constexpr std::uint32_t buckets = 1u << bits;
    std::vector<std::uint32_t> next(rows);
    for (int shift = 0; shift < 64 && spread >> shift != 0; shift += bits) {
      const auto digit = [=](std::uint32_t row) { return ((ids[row] - lowest) >> shift) & (buckets - 1); };
      std::array<std::uint32_t, buckets> start{};
      for (std::uint32_t row = 0; row < rows; ++row) ++start[digit(row)];
      std::uint32_t sum = 0;
      for (std::uint32_t& s : start) sum += std::exchange(s, sum);
      for (std::uint32_t row : row_of_rank) next[start[digit(row)]++] = row;
      row_of_rank.swap(next);
    }
    for (std::uint32_t k = 0; k < rows; ++k) rank_of_row[row_of_rank[k]] = k;
  }
};

}  // namespace sph
