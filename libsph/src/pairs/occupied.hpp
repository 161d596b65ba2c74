// The occupied ones of many cells, numbered in ascending order: what is then kept for each of them costs
// nothing for the empty rest of a wide domain. Where cells are not many more than rows they are looked up in
// two bits a cell; else in a sorted list of the occupied ones.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sph {

class Occupied {
 public:
  /// May arrays have an element for each of so many cells, beside so many rows?
  [[nodiscard]] static constexpr bool dense(std::size_t cells, std::size_t rows) {
    return cells / 16 <= rows + 4096;
  }

  Occupied(std::size_t cells, std::size_t rows)
      : dense_(dense(cells, rows)), words_(dense_ ? cells / 64 + 1 : 0) {}
  void mark(std::size_t cell) {
    if (dense_)
      words_[cell / 64].bits |= std::uint64_t{1} << (cell % 64);
    else if (marked_.empty() || marked_.back() != cell)
      marked_.push_back(cell);
  }
  /// Numbers the cells marked so far; returns how many.
  std::uint32_t number() {
    if (!dense_) {
      std::ranges::sort(marked_);
      marked_.erase(std::unique(marked_.begin(), marked_.end()), marked_.end());
      return static_cast<std::uint32_t>(marked_.size());
    }
    std::uint32_t sum = 0;
    for (Word& w : words_) {
      w.before = sum;
      sum += static_cast<std::uint32_t>(std::popcount(w.bits));
    }
    return sum;
  }
  /// How many occupied cells come before `cell`, one beyond the last included.
  [[nodiscard]] std::uint32_t before(std::size_t cell) const {
    if (!dense_) return static_cast<std::uint32_t>(std::ranges::lower_bound(marked_, cell) - marked_.begin());
    const Word& w = words_[cell / 64];
    const std::uint64_t below = w.bits & ((std::uint64_t{1} << (cell % 64)) - 1);
    return w.before + static_cast<std::uint32_t>(std::popcount(below));
  }

 private:
  struct Word {
    std::uint64_t bits = 0;
    std::uint32_t before = 0;
  };
  bool dense_;
  std::vector<Word> words_;
  std::vector<std::size_t> marked_;
};

}  // namespace sph
