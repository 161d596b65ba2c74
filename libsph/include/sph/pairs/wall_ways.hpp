// How far grains and walls have gone towards each other since grains were listed with the walls near them: another wall is
// not touched before that is as far as lists reach beyond the grain.
#pragma once

#include "sph/core/particles.hpp"
#include "sph/pairs/wall_places.hpp"
#include "sph/pairs/ways_apart.hpp"

namespace sph {

class WallWays {
 public:
  /// Walls are here, grains where `ways` begin, and lists reach so far beyond grains [m].
  void begin(const WallsNow& walls, const WaysApart& ways, double skin, double quantum) {
    then_ = walls;
    skin_ = skin;
    quantum_ = quantum;
    rounding_ = 4 * ways.unit() * quantum;
  }
  /// Bound on that of any owned grain and any wall that it is not listed with and that is near now [m].
  [[nodiscard]] double look(const Particles& grains, const WaysApart& ways, const WallsNow& now) const;

 private:
  struct Grain;
  [[nodiscard]] double to_plane(std::size_t plane, const Grain& grain, const PlaneNow& now) const;
  [[nodiscard]] double to_mesh(std::size_t mesh, const Grain& grain, const MeshNow& now) const;

  WallsNow then_;
  double skin_ = 0, quantum_ = 0;
  double rounding_ = 0;  ///< of a way [m]
};

}  // namespace sph
