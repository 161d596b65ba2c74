// Rows of the start's lattice along x, and which group is painted where on them, by arithmetic: 10^10 points are looked at
// in seconds.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/lattice.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

/// Indices along x, first <= k < end, of one group; -1: empty.
struct RowPart {
  std::int64_t first = 0, end = 0;
  int group = -1;
};

class LatticeRows {
 public:
  /// Regions that may meet a row more than once are looked at point by point. `that_empty` leaves out those of a group: a
  /// row that is full without them is full.
  enum class Bays { all, that_empty };
  LatticeRows(const Scene& scene, const Lattice& lattice, Bays bays = Bays::all)
      : scene_(scene), lattice_(lattice), bays_(bays) {}

  /// Of the row (y, z) what lies in the filled extent, from end to end. Valid until the next call.
  [[nodiscard]] const std::vector<RowPart>& parts(std::int64_t y, std::int64_t z);

 private:
  const Scene& scene_;
  const Lattice& lattice_;
  Bays bays_;
  std::vector<RowPart> painted_, parts_;
  std::vector<std::int64_t> ends_;
};

/// Of the row (y, z) what lies in the filled extent.
[[nodiscard]] RowPart filled_part(const Scene& scene, const Lattice& lattice, std::int64_t y, std::int64_t z);

}  // namespace sph
