// The occupied ones of many cells, numbered in ascending order: what is then kept for each of them costs
// nothing for the empty rest of a wide domain, which takes two bits a cell.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sph {

class Occupied {
 public:
  explicit Occupied(std::size_t cells) : words_(cells / 64 + 1) {}
  void mark(std::size_t cell) { words_[cell / 64].bits |= std::uint64_t{1} << (cell % 64); }
  /// Numbers the cells marked so far; returns how many.
  std::uint32_t number() {
    std::uint32_t sum = 0;
    for (Word& w : words_) {
      w.before = sum;
      sum += static_cast<std::uint32_t>(std::popcount(w.bits));
    }
    return sum;
  }
  /// How many occupied cells come before `cell`, one beyond the last included.
  [[nodiscard]] std::uint32_t before(std::size_t cell) const {
    const Word& w = words_[cell / 64];
    const std::uint64_t below = w.bits & ((std::uint64_t{1} << (cell % 64)) - 1);
    return w.before + static_cast<std::uint32_t>(std::popcount(below));
  }

 private:
  struct Word {
    std::uint64_t bits = 0;
    std::uint32_t before = 0;
  };
  std::vector<Word> words_;
};

}  // namespace sph
