// From the shape that a scene names to the kernel.
#pragma once

#include "sph/core/kernels.hpp"
#include "sph/scene/frame_scene.hpp"

namespace sph {

template <class Function>
auto with_kernel(KernelShape shape, Function function) {
  switch (shape) {
    case KernelShape::wendland_c2:
      return function(WendlandC2{});
    case KernelShape::wendland_c4:
      return function(WendlandC4{});
    case KernelShape::quintic:
      break;
  }
  return function(Quintic{});
}

/// w(q), without its normalisation.
[[nodiscard]] inline double kernel_value(KernelShape shape, int dim, double q) {
  return with_kernel(shape, [&]<class Kernel>(Kernel) {
    return dim == 2 ? Kernel::template value<2>(q) : Kernel::template value<3>(q);
  });
}

/// alpha_D
[[nodiscard]] inline double kernel_normalisation(KernelShape shape, int dim) {
  return with_kernel(shape, [&]<class Kernel>(Kernel) {
    return dim == 2 ? Kernel::template normalisation<2> : Kernel::template normalisation<3>;
  });
}

}  // namespace sph
