// What of the ways of grains is known since their lists were made.
#pragma once

#include <algorithm>
#include <cstdint>

#include "sph/pairs/set_pair.hpp"
#include "sph/pairs/wall_ways.hpp"
#include "sph/pairs/ways_apart.hpp"

namespace sph {

class GrainWays {
 public:
  /// Lists were made here, and reach so far [quanta], beyond grains by the skin [m].
  void begin(const Particles& grains, const WallsNow& walls, std::int64_t reach, double skin,
             double quantum) {
    apart_.begin(grains, reach);
    to_walls_.begin(walls, apart_, skin, quantum);
    quantum_ = quantum;
    path_ = 0;
  }
  /// Grains have moved by at most `way` [m] and a rounding.
  void moved(double way) { path_ += way + 2 * quantum_; }
  [[nodiscard]] double path() const { return path_; }  ///< no grain has gone further [m]

  /// Bounds as they are.
  [[nodiscard]] SetPair::Ways look(const Particles& grains, const WallsNow& walls) const {
    const WaysApart::Ways found = apart_.look(grains, {}, 0);
    return {1.0001 * found.alone * quantum_,
            std::max(1.0001 * found.together * quantum_, to_walls_.look(grains, apart_, walls))};
  }

 private:
  WaysApart apart_;
  WallWays to_walls_;
  double quantum_ = 0, path_ = 0;
};

}  // namespace sph
