// The one reduction of a step: what all ranks must know, as maxima and as sums of integers, which do not
// depend on any order. What it brings acts in the next step.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "decomp/combined_reduction.hpp"

namespace sph {

class Reduction {
 public:
  /// A place in it, given out before the first step.
  struct Maximum {
    std::size_t at = 0;
  };
  struct Sums {
    std::size_t first = 0, count = 0;
  };
  // Of every scene.
  static constexpr Maximum speed{0};         ///< [m/s]
  static constexpr Maximum acceleration{1};  ///< [m/s^2]
  static constexpr Maximum bad{2};           ///< 1: something is not finite
  static constexpr Maximum left{3};          ///< 1: a particle is outside the domain
  static constexpr Maximum request{4};       ///< what the caller of the step asked for

  [[nodiscard]] Maximum add_maximum() {
    maxima_.push_back(0);
    return {maxima_.size() - 1};
  }
  [[nodiscard]] Sums add_sums(std::size_t count) {
    sums_.resize(sums_.size() + count);
    return {sums_.size() - count, count};
  }

  /// All 0: a step begins.
  void clear() {
    maxima_.assign(maxima_.size(), 0);
    sums_.assign(sums_.size(), 0);
  }
  [[nodiscard]] double& operator[](Maximum m) { return maxima_[m.at]; }
  [[nodiscard]] double operator[](Maximum m) const { return maxima_[m.at]; }
  [[nodiscard]] std::span<std::int64_t> operator[](Sums s) {
    return std::span(sums_).subspan(s.first, s.count);
  }
  [[nodiscard]] std::span<const std::int64_t> operator[](Sums s) const {
    return std::span(sums_).subspan(s.first, s.count);
  }

  /// Over all ranks. Collective.
  void combine(const decomp::Comm& comm) {
    if (sums_.empty())
      comm.max(maxima_);
    else
      decomp::max_and_sum(comm, maxima_, sums_);
  }

 private:
  std::vector<double> maxima_ = std::vector<double>(5);
  std::vector<std::int64_t> sums_;
};

}  // namespace sph
