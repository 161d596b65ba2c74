#include "sph/surface_gradient.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sph/kernels.hpp"

namespace sph {
namespace {

constexpr std::size_t points = 257;

/// w at depth k step, k = 0, 1, ... to the kernel's radius, lengths in h: W summed over the line (2D) or the
/// plane (3D) at that distance. Sums, products and sqrt alone, so that all compilers find the same bits.
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

template <class Kernel>
std::vector<double> table(int dim) {
  constexpr double step = 1.0 / 256;
  const std::vector<double> w = dim == 2 ? plane_sums<Kernel, 2>(step) : plane_sums<Kernel, 3>(step);
  std::vector<double> out(points, 0.0);
  double below = 0.5;
  std::size_t k = 0;
  for (std::size_t n = 0; n + 1 < points; ++n) {
    const double wanted = 0.5 + 0.5 * static_cast<double>(n) / (points - 1);
    while (k + 1 < w.size() && below + 0.5 * step * (w[k] + w[k + 1]) < wanted) {
      below += 0.5 * step * (w[k] + w[k + 1]);
      ++k;
    }
    out[n] = w[k];
  }
  return out;
}

}  // namespace

SurfaceGradient::SurfaceGradient(KernelShape kernel, int dim) {
  switch (kernel) {
    case KernelShape::quintic:
      gradient_ = table<Quintic>(dim);
      break;
    case KernelShape::wendland_c2:
      gradient_ = table<WendlandC2>(dim);
      break;
    case KernelShape::wendland_c4:
      gradient_ = table<WendlandC4>(dim);
      break;
  }
}

double SurfaceGradient::operator()(double concentration) const {
  const double at = (points - 1) * std::clamp(2 * concentration - 1, 0.0, 1.0);
  const auto k = std::min(static_cast<std::size_t>(at), points - 2);
  const double part = at - static_cast<double>(k);
  return gradient_[k] + part * (gradient_[k + 1] - gradient_[k]);
}

}  // namespace sph
