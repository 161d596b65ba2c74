#include "sph/laws/neo_hooke.hpp"

namespace sph {
namespace {

/// The part of cof(1 + H) - (1 + tr H) 1 + H^T that is of second order: none in the plane.
Tensor<2> second_order_cofactor(const Tensor<2>&) { return Tensor<2>::Zero(); }

Tensor<3> second_order_cofactor(const Tensor<3>& h) {
  Tensor<3> c;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      c(i, j) = h(i1, j1) * h(i2, j2) - h(i1, j2) * h(i2, j1);
    }
  return c;
}

/// J - 1 - tr H.
double volume_change_beyond_trace(const Tensor<2>& h, const Tensor<2>&) {
  return h(0, 0) * h(1, 1) - h(0, 1) * h(1, 0);
}

double volume_change_beyond_trace(const Tensor<3>& h, const Tensor<3>& cofactor) {
  const double determinant = (h(0, 0) * cofactor(0, 0) + h(0, 1) * cofactor(0, 1)) + h(0, 2) * cofactor(0, 2);
  return ((cofactor(0, 0) + cofactor(1, 1)) + cofactor(2, 2)) + determinant;
}

}  // namespace

template <int D>
ElasticState<D> neo_hooke(const Tensor<D>& h, double bulk_modulus, double shear_modulus, double pressure) {
  double trace = 0, square = 0;
  for (int i = 0; i < D; ++i) {
    trace += h(i, i);
    for (int j = 0; j < D; ++j) square += h(i, j) * h(i, j);
  }
  const Tensor<D> second = second_order_cofactor(h);
  const double beyond = volume_change_beyond_trace(h, second);
  const double change = trace + beyond;
  const double lambda = bulk_modulus + shear_modulus / 3;
  ElasticState<D> out;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) {
      // F - cof F, then cof F = dJ/dF
      const double distortion = h(i, j) + h(j, i) - second(i, j) - (i == j ? trace : 0.0);
      const double cofactor = second(i, j) - h(j, i) + (i == j ? 1 + trace : 0.0);
      out.first_piola(i, j) = shear_modulus * distortion + (lambda * change - pressure) * cofactor;
    }
  out.volume_change = change;
  out.energy = shear_modulus * (0.5 * square - beyond) + 0.5 * lambda * change * change - pressure * change;
  return out;
}

template ElasticState<2> neo_hooke<2>(const Tensor<2>&, double, double, double);
template ElasticState<3> neo_hooke<3>(const Tensor<3>&, double, double, double);

}  // namespace sph
