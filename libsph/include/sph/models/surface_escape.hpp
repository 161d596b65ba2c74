// What leaves through a free surface, beyond which there are no particles (after Morris et al. 1997, for walls): with a
// straight profile from a particle at the distance d to the surface, where the potential is given, the exchange with
// what is missing of its kernel is 2 |S| / d times the difference, S the gradient of the concentration C. Only where C
// is below 0.9 and |S| at least half of what belongs to C: inside, disorder would leak (15 to 180 %). What the rows
// beyond that gate would have let out, the rows within let out in their place.
#pragma once

#include "sph/models/sph_constants.hpp"
#include "sph/models/surface_gradient.hpp"
#include "sph/models/wall_distance.hpp"

namespace sph {

class SurfaceEscape {
 public:
  static constexpr FieldSet reads{Field::spread, Field::mass, Field::density};
  using Particles = View<reads, FieldSet{}>;

  explicit SurfaceEscape(const SphConstants& constants);
  /// 2 |S| / d of a particle [1/m^2], 0 where it is not at a surface.
  [[nodiscard]] double operator()(const Particles& particles, std::size_t row) const;

 private:
  const SphConstants* constants_;
  SurfaceGradient gradient_;
  WallDistance distance_;
  double gain_;  ///< of the rows within the gate
};

}  // namespace sph
