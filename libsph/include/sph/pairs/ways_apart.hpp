// How far particles have gone, and how far neighbours have gone apart, since their lists were made. What flows together
// need not be listed anew: two that are not in each other's lists were further apart than lists reach, and are not near
// before they have gone as far towards each other as lists reach beyond the range.
#pragma once

#include <cstdint>
#include <vector>

#include "decomp/memory.hpp"
#include "sph/core/particles.hpp"

namespace sph {

class WaysApart {
 public:
  /// From where all rows are now, halo copies included, with lists that reach so far [quanta].
  void begin(const Particles& particles, std::int64_t reach);

  struct Ways {
    double alone = 0;  ///< bound on that of any row [quanta]
    double together =
        0;  ///< bound on how far two rows have gone apart that are no further apart than lists reach [quanta]
  };
  /// When all rows but those of walls, by group, will have drifted on with their velocities for `time` [quanta per m/s]; where
  /// that is 0, nothing but places is looked at.
  /// Positions and velocities of the halo are those of now; rows are those of begin(), and none has gone, or will
  /// have, further than lists reach.
  [[nodiscard]] Ways look(const Particles& particles, const std::vector<bool>& is_wall, double time) const;

  /// Way of a row that is at x along an axis [quanta], but for less than a unit.
  [[nodiscard]] std::int64_t way(std::size_t row, std::size_t axis, std::int64_t x) const {
    return std::int64_t{units(row * dim_ + axis, x)} * (std::int64_t{1} << shift_);
  }
  [[nodiscard]] double unit() const { return static_cast<double>(std::int64_t{1} << shift_); }  ///< [quanta]

 private:
  [[nodiscard]] std::int32_t units(std::size_t component, std::int64_t x) const {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(x >> shift_) - begin_[component]);
  }
  template <int D>
  [[nodiscard]] Ways look_in(const Particles& particles, const std::vector<bool>& is_wall, double time) const;

  std::size_t dim_ = 3;
  std::int64_t reach_ = 0;
  int shift_ = 0;  ///< places are kept in units of 2^shift quanta, lists reach less than 2^28 of these
  decomp::LargeVector<std::uint32_t> begin_;  ///< low words of the positions, [row][component]
};

}  // namespace sph
