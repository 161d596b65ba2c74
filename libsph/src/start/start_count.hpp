// How many particles a start makes, without making any: a scene of 10^10 is looked at in seconds.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "decomp/comm.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

/// From the lowest to the highest of some points against gravity, along periods not counted [m].
struct Height {
  double low = HUGE_VAL, high = -HUGE_VAL;
  void add(const Scene& scene, const Double3& x);
  /// Of all ranks, element by element. Collective.
  static void unite(const decomp::Comm& comm, std::vector<Height>& heights);
};

struct StartCount {
  std::int64_t all = 0;
  std::vector<std::int64_t> by_group;  ///< empty: not known without reading all rows of the file
  std::vector<Height> heights;         ///< by group, of a lattice
};

/// Of a lattice exact, row by row of it; of a file from its size, exact for HDF5. Of a tile from its own
/// rows. Collective.
[[nodiscard]] StartCount count_start(const decomp::Comm& comm, const Scene& scene);

}  // namespace sph
