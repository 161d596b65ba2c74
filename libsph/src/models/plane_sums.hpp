// A kernel summed over the planes (lines in 2D) at each depth: what flat surfaces and walls take of it.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "sph/core/kernels.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

/// w at depths 0, step, 2 step, ... to the kernel's radius, lengths in h. Sums, products and sqrt alone, so
/// that all compilers find the same bits.
template <class Kernel, int D>
std::vector<double> plane_sums(double step) {
  std::vector<double> sums;
  for (double z = 0; z <= Kernel::radius; z += step) {
    double sum = 0;
    for (double y = 0.5 * step; y < Kernel::radius; y += step) {
      const double weight = D == 2 ? 2 : 2 * std::numbers::pi * y;
      sum += weight * step * Kernel::template value<D>(std::sqrt(z * z + y * y));
    }
    sums.push_back(sum * Kernel::template normalisation<D>);
  }
  return sums;
}

inline std::vector<double> plane_sums(KernelShape kernel, int dim, double step) {
  const auto of = [&]<class Kernel>() {
    return dim == 2 ? plane_sums<Kernel, 2>(step) : plane_sums<Kernel, 3>(step);
  };
  switch (kernel) {
    case KernelShape::wendland_c2:
      return of.template operator()<WendlandC2>();
    case KernelShape::wendland_c4:
      return of.template operator()<WendlandC4>();
    case KernelShape::quintic:
      break;
  }
  return of.template operator()<Quintic>();
}

}  // namespace sph
