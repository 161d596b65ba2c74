#include "sph/models/wall_distance.hpp"

#include <algorithm>
#include <cmath>

#include "core/table.hpp"
#include "models/plane_sums.hpp"

namespace sph {
namespace {

constexpr std::size_t points = 257;
constexpr std::size_t steps = 256;  ///< to a spacing

}  // namespace

WallDistance::WallDistance(KernelShape kernel, int dim, double spacing)
    : gradient_(points), distance_(points) {
  const double step = spacing / steps;
  const std::vector<double> w = plane_sums(kernel, dim, step);
  const auto share_at = [&](std::size_t k) {
    double sum = 0;
    for (std::size_t row = k + steps / 2; row < w.size(); row += steps) sum += spacing * w[row];
    return sum;
  };
  at_face_ = share_at(0);
  // From the face outwards the share falls; the table is filled from its end.
  std::size_t k = 0;
  double here = at_face_, next = share_at(1);
  for (std::size_t n = points; n-- > 0;) {
    const double root = static_cast<double>(n) / (points - 1), wanted = at_face_ * root * root;
    while (next > wanted) {
      here = next;
      next = share_at(++k + 1);
    }
    gradient_[n] = (here - next) / step;
    distance_[n] = step * (static_cast<double>(k) + (here > next ? (here - wanted) / (here - next) : 0.0));
  }
  // What two or three walls leave free is the product of what each does, but for the kernel's roundness.
  constexpr double roundness = 0.1;  // of a spacing
  double free = 1;
  for (int a = 0; a < dim; ++a) free *= 1 - share_at(steps / 2);
  depth_in_corner_ = std::fmax(0.0, depth(1 - free) + roundness * spacing);
}

double WallDistance::look_up(const std::vector<double>& table, double share) const {
  if (!(share > 0)) return table.front();
  return between(table, (points - 1) * std::sqrt(std::min(share / at_face_, 1.0)));
}

double WallDistance::operator()(double share) const { return look_up(distance_, share); }

double WallDistance::depth(double share) const {
  return share > at_face_ ? look_up(distance_, 2 * at_face_ - share) : -look_up(distance_, share);
}

double WallDistance::gradient(double share) const {
  return look_up(gradient_, std::min(share, 2 * at_face_ - share));
}

}  // namespace sph
