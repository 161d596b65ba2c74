#include "sph/models/surface_gradient.hpp"

#include <algorithm>

#include "core/table.hpp"
#include "models/plane_sums.hpp"

namespace sph {
namespace {

constexpr std::size_t points = 257;

}  // namespace

SurfaceGradient::SurfaceGradient(KernelShape kernel, int dim) : gradient_(points, 0.0) {
  constexpr double step = 1.0 / 256;
  const std::vector<double> w = plane_sums(kernel, dim, step);
  double below = 0.5;
  std::size_t k = 0;
  for (std::size_t n = 0; n + 1 < points; ++n) {
    const double wanted = 0.5 + 0.5 * static_cast<double>(n) / (points - 1);
    while (k + 1 < w.size() && below + 0.5 * step * (w[k] + w[k + 1]) < wanted) {
      below += 0.5 * step * (w[k] + w[k + 1]);
      ++k;
    }
    gradient_[n] = w[k];
  }
}

double SurfaceGradient::operator()(double concentration) const {
  return between(gradient_, (points - 1) * std::clamp(2 * concentration - 1, 0.0, 1.0));
}

}  // namespace sph
