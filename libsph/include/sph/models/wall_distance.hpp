// How far a flat wall is from a particle of whose kernel it fills a given share. Walls are rows of particles,
// the first of them half a spacing behind the face: the share is that of the rows, 5 % of a spacing better
// than that of a half space.
#pragma once

#include <vector>

#include "sph/scene/scene.hpp"

namespace sph {

class WallDistance {
 public:
  /// `spacing` over h.
  WallDistance(KernelShape kernel, int dim, double spacing);

  /// Distance over h; 0 for the share at the face and more, half a spacing less than the kernel's radius
  /// for a share of 0.
  [[nodiscard]] double operator()(double share) const;
  /// How far behind the face over h, negative before it.
  [[nodiscard]] double depth(double share) const;
  /// The same for a particle half a spacing before two walls at right angles, in 3D three; at least 0.
  [[nodiscard]] double depth_in_corner() const { return depth_in_corner_; }
  /// h times the share's gradient there.
  [[nodiscard]] double gradient(double share) const;

 private:
  double at_face_ = 0;  ///< share, about 1/2
  double depth_in_corner_ = 0;
  [[nodiscard]] double look_up(const std::vector<double>& table, double share) const;
  std::vector<double> gradient_;  ///< as distance_
  std::vector<double> distance_;  ///< at shares 0 to at_face_, their square roots evenly
};

}  // namespace sph
