// How a wall that does not slip continues the velocity beside it: v_w = v_wall - k (<v> - v_wall), <v> the
// kernel mean of the fluid's velocity near the wall particle. k = 1 (Adami et al. 2012) is the mirror image
// only of a particle as deep behind the wall's face as the fluid that it sees is before it. k = d / m, d its
// depth and m the mean distance of that fluid from the face, continues a linear profile exactly. What a wall
// particle can measure is the distance D to the mean position of the fluid that it sees; over a flat wall D =
// d + m, and d and m follow from D on a lattice whose first row is half a spacing from the face. This is
// asked once, at the start. Later the rows next to a wall move by some 0.05 spacings, and whether k follows
// from their D or from the depth, the error of the viscous sum over such rows is then larger: it vanishes
// where <v> shrinks with the distance of the row to the wall, as in the mirror image. (Lid-driven cavity,
// Re 100, 50 x 50: error 0.83 and 0.73 % so, 0.59 % with the k of the start, 0.72 % with 1.)
#pragma once

#include <vector>

#include "sph/scene/scene.hpp"

namespace sph {

class WallMirror {
 public:
  WallMirror(const Scene& scene, double smoothing_length);
  /// k where D / h is `distance`, 0 on the face and where fluid is all around; 1 where the sum of the kernel,
  /// `weight`, is too small for a flat wall: beside the edge of the fluid and in corners.
  [[nodiscard]] double operator()(double distance, double weight) const;

 private:
  double first_ = 0, step_ = 0;                ///< D / h of the table's points
  std::vector<double> factor_, least_weight_;  ///< k at them, and what it takes
};

}  // namespace sph
