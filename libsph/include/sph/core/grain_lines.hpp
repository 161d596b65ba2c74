// What a sweep over contacts reads of a grain and changes, in whole cache lines. A pair's partners lie anywhere: in columns a
// grain takes seven lines, here two. Rows are those of the particles, halo copies included.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "decomp/memory.hpp"
#include "sph/core/fields.hpp"

namespace sph {

struct GrainLines {
  static constexpr std::size_t motion_width = 8, spin_width = 4;
  decomp::LargeVector<double> motion;  ///< position (bits of integers) [quanta], radius | velocity, mass
  decomp::LargeVector<double> spin;    ///< spin, group

  /// What the halo has of these fields (decomp/poison.hpp).
  void poison(FieldSet fields, std::size_t owned);
};

/// Where rows are, in columns or in lines, which stay what they are [quanta].
class RowPlaces {
 public:
  RowPlaces(const void* first, std::size_t bytes_of_row)
      : first_(static_cast<const std::byte*>(first)), bytes_(bytes_of_row) {}
  [[nodiscard]] std::int64_t operator()(std::size_t row, std::size_t axis) const {
    std::int64_t x;
    std::memcpy(&x, first_ + row * bytes_ + axis * sizeof x, sizeof x);
    return x;
  }

 private:
  const std::byte* first_;
  std::size_t bytes_;
};

/// The bits of the coordinates that a row of GrainLines::motion begins with.
[[nodiscard]] inline std::array<std::int64_t, 3> position_in(const void* line) {
  std::array<std::int64_t, 3> x;
  std::memcpy(x.data(), line, sizeof x);
  return x;
}

}  // namespace sph
