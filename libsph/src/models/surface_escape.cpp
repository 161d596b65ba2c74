#include "sph/models/surface_escape.hpp"

#include <cmath>

#include "sph/core/kernels.hpp"

namespace sph {
namespace {

constexpr double open_below = 0.9, of_gradient = 0.5, nearest = 0.25;

/// Concentration and its gradient, as the sums of terms/shifting.hpp have them, in the rows of a square lattice below a
/// flat surface; lengths in h.
template <class Kernel, int D>
double share_of_open_rows(double q) {
  const int reach = static_cast<int>(Kernel::radius / q) + 1, across = D == 3 ? reach : 0;
  const double volume = D == 3 ? q * q * q : q * q;
  const double w_spacing = Kernel::template value<D>(q);
  double sum = 0;
  for (int row = 0; row < reach; ++row) {
    double concentration = 0, gradient = 0;
    for (int up = -row; up <= reach; ++up)
      for (int a = -reach; a <= reach; ++a)
        for (int b = -across; b <= across; ++b) {
          const double r = q * std::sqrt(static_cast<double>(up * up + a * a + b * b));
          const double w = Kernel::template value<D>(r), ratio = w / w_spacing;
          concentration += w;
          if (r > 0)
            gradient -=
                Kernel::template slope<D>(r) / r * (up * q) * (1 + 0.2 * (ratio * ratio * ratio * ratio));
        }
    const double scale = volume * Kernel::template normalisation<D>;
    if (scale * concentration < open_below) sum += 2 * q * scale * gradient;
  }
  return sum;
}

template <class Kernel>
double share_of_open_rows(int dim, double q) {
  return dim == 2 ? share_of_open_rows<Kernel, 2>(q) : share_of_open_rows<Kernel, 3>(q);
}

double share_of_open_rows(const Scene& scene) {
  const double q = scene.start.spacing / scene.kernel.smoothing_length;
  switch (scene.kernel.shape) {
    case KernelShape::wendland_c2:
      return share_of_open_rows<WendlandC2>(scene.dim, q);
    case KernelShape::wendland_c4:
      return share_of_open_rows<WendlandC4>(scene.dim, q);
    case KernelShape::quintic:
      break;
  }
  return share_of_open_rows<Quintic>(scene.dim, q);
}

}  // namespace

SurfaceEscape::SurfaceEscape(const SphConstants& constants)
    : constants_(&constants),
      gradient_(constants.scene->kernel.shape, constants.scene->dim),
      distance_(constants.scene->kernel.shape, constants.scene->dim,
                constants.scene->start.spacing / constants.scene->kernel.smoothing_length),
      gain_(1 / share_of_open_rows(*constants.scene)) {}

double SurfaceEscape::operator()(const Particles& p, std::size_t i) const {
  const auto d = static_cast<std::size_t>(p.dim());
  const double h = constants_->scene->kernel.smoothing_length;
  const double* spread = p.get<Field::spread>() + i * (d + 2);
  const double volume =
      p.get<Field::mass>()[i] / p.get<Field::density>()[i] * constants_->row_scale.inverse_volume;
  const double concentration = h * spread[d] + volume * constants_->own_concentration;
  if (!(concentration < open_below)) return 0;
  double square = 0;
  for (std::size_t a = 0; a < d; ++a) square += spread[a] * spread[a];
  const double slope = h * std::sqrt(square);
  if (slope < of_gradient * gradient_(concentration)) return 0;
  const double away = std::fmax(distance_(1 - concentration), nearest * constants_->scene->start.spacing / h);
  return 2 * gain_ * slope / (away * h * h);
}

}  // namespace sph
