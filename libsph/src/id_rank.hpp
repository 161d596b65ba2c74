// The order of a rank's rows by global id as 32-bit ranks: what lists are sorted by. Radix sort, 11 bits a
// pass, as many passes as the spread of the ids needs.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace sph {

class IdRank {
 public:
  IdRank(const std::uint64_t* ids, std::size_t rows) : row_(rows), rank_(rows) {
    if (rows == 0) return;
    std::uint64_t lowest = ids[0], highest = ids[0];
    for (std::size_t i = 0; i < rows; ++i) {
      lowest = ids[i] < lowest ? ids[i] : lowest;
      highest = ids[i] > highest ? ids[i] : highest;
      row_[i] = static_cast<std::uint32_t>(i);
    }
    std::vector<std::uint32_t> next(rows);
    for (int shift = 0; shift < 64 && (highest - lowest) >> shift != 0; shift += bits) {
      const auto digit = [=](std::uint32_t row) { return ((ids[row] - lowest) >> shift) & (buckets - 1); };
      std::array<std::uint32_t, buckets> start{};
      for (std::size_t i = 0; i < rows; ++i) ++start[digit(static_cast<std::uint32_t>(i))];
      std::uint32_t sum = 0;
      for (std::uint32_t& s : start) sum += std::exchange(s, sum);
      for (std::uint32_t row : row_) next[start[digit(row)]++] = row;
      row_.swap(next);
    }
    for (std::size_t k = 0; k < rows; ++k) rank_[row_[k]] = static_cast<std::uint32_t>(k);
  }
  [[nodiscard]] std::uint32_t rank_of_row(std::uint32_t row) const { return rank_[row]; }
  [[nodiscard]] std::uint32_t row_of_rank(std::uint32_t rank) const { return row_[rank]; }

 private:
  static constexpr int bits = 11;
  static constexpr std::uint32_t buckets = 1u << bits;
  std::vector<std::uint32_t> row_, rank_;
};

}  // namespace sph
