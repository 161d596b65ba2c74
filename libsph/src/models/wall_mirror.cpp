#include "sph/models/wall_mirror.hpp"

#include <algorithm>
#include <cmath>

#include "core/table.hpp"
#include "sph/core/kernels.hpp"

namespace sph {
namespace {

constexpr std::size_t points = 257;
constexpr double flat = 0.7;  ///< of the weight that a flat wall sees at its distance

/// Of the lattice before the face, seen from a depth; lengths in h.
struct View {
  double depth, mean;  ///< d, m
  double weight;       ///< sum of the kernel without its factor
  [[nodiscard]] double distance() const { return depth + mean; }
};

/// Sums, products and sqrt alone, so that all compilers find the same bits.
template <class Kernel>
View view(int dim, double spacing, double depth) {
  const int reach = static_cast<int>(Kernel::radius / spacing) + 1;
  double weight = 0, first_moment = 0;
  for (int row = 0; row <= reach; ++row) {
    const double y = (row + 0.5) * spacing, z = depth + y;
    for (int a = -reach; a <= reach; ++a)
      for (int b = dim == 2 ? 0 : -reach; b <= (dim == 2 ? 0 : reach); ++b) {
        const double w = Kernel::template value<3>(std::sqrt(z * z + (a * a + b * b) * (spacing * spacing)));
        weight += w;
        first_moment += w * y;
      }
  }
  return {depth, weight > 0 ? first_moment / weight : 0.5 * spacing, weight};
}

template <class Kernel>
std::vector<View> views(int dim, double spacing) {
  std::vector<View> out;
  const double deepest = Kernel::radius - 0.5 * spacing;  // which no longer sees the first row
  for (std::size_t n = 0; n < points; ++n)
    out.push_back(view<Kernel>(dim, spacing, deepest * static_cast<double>(n) / (points - 1)));
  return out;
}

}  // namespace

WallMirror::WallMirror(const Scene& scene, double smoothing_length) {
  const double spacing = scene.start.spacing / smoothing_length;
  const std::vector<View> at = scene.kernel.shape == KernelShape::quintic ? views<Quintic>(scene.dim, spacing)
                               : scene.kernel.shape == KernelShape::wendland_c2
                                   ? views<WendlandC2>(scene.dim, spacing)
                                   : views<WendlandC4>(scene.dim, spacing);
  first_ = at.front().distance();
  step_ = (at.back().distance() - first_) / (points - 1);
  std::size_t k = 0;
  for (std::size_t n = 0; n < points; ++n) {
    const double wanted = first_ + static_cast<double>(n) * step_;
    while (k + 2 < points && at[k + 1].distance() < wanted) ++k;
    const double part =
        std::clamp((wanted - at[k].distance()) / (at[k + 1].distance() - at[k].distance()), 0.0, 1.0);
    const double depth = at[k].depth + part * (at[k + 1].depth - at[k].depth);
    factor_.push_back(depth / (at[k].mean + part * (at[k + 1].mean - at[k].mean)));
    least_weight_.push_back(flat * (at[k].weight + part * (at[k + 1].weight - at[k].weight)));
  }
}

double WallMirror::operator()(double distance, double weight) const {
  if (!(distance > first_)) return factor_.front();
  const double at = std::min((distance - first_) / step_, static_cast<double>(points - 1));
  return weight < between(least_weight_, at) ? 1.0 : between(factor_, at);
}

}  // namespace sph
