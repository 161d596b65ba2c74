// What the concentration C = sum V W does at a flat free surface. A particle at depth z below it has the
// share C(z) of the kernel's volume filled, and grad C = w(z), the kernel summed over planes: the gradient
// that is expected at a concentration. Shifting goes against what is left of the gradient beside it; against
// all of it particles would leave through the surface.
#pragma once

#include <cstddef>
#include <vector>

#include "sph/scene/scene.hpp"

namespace sph {

class SurfaceGradient {
 public:
  SurfaceGradient(KernelShape kernel, int dim);

  /// h |grad C| where C is `concentration`; 0 above 1.
  [[nodiscard]] double operator()(double concentration) const;

 private:
  std::vector<double> gradient_;  ///< at concentrations 1/2 to 1, evenly
};

}  // namespace sph
