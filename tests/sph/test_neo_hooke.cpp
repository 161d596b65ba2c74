#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "sph/laws/neo_hooke.hpp"

namespace {

using sph::neo_hooke, sph::Tensor;

constexpr double K = 3e6, mu = 7e5;

template <int D>
Tensor<D> some_gradient() {
  Tensor<D> h;
  if constexpr (D == 2)
    h << 0.2, -0.3, 0.1, -0.15;
  else
    h << 0.2, -0.3, 0.1, -0.15, 0.05, 0.25, 0.07, -0.12, -0.1;
  return h;
}

template <int D>
Tensor<D> rotation(double angle) {
  Tensor<D> r = Tensor<D>::Identity();
  r(0, 0) = r(1, 1) = std::cos(angle);
  r(1, 0) = std::sin(angle);
  r(0, 1) = -r(1, 0);
  return r;
}

template <int D>
void stress_is_the_derivative_of_the_energy() {
  const Tensor<D> h = some_gradient<D>();
  const Tensor<D> stress = neo_hooke<D>(h, K, mu).first_piola;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) {
      constexpr double step = 1e-5;
      Tensor<D> more = h, less = h;
      more(i, j) += step, less(i, j) -= step;
      const double slope = (neo_hooke<D>(more, K, mu).energy - neo_hooke<D>(less, K, mu).energy) / (2 * step);
      EXPECT_NEAR(stress(i, j), slope, 1e-8 * K) << i << j;
    }
}
TEST(NeoHooke, StressIsTheDerivativeOfTheEnergy) {
  stress_is_the_derivative_of_the_energy<2>();
  stress_is_the_derivative_of_the_energy<3>();
}

template <int D>
void small_strains_have_the_moduli() {
  const Tensor<D> h = 1e-7 * some_gradient<D>();
  const Tensor<D> stress = neo_hooke<D>(h, K, mu).first_piola;
  const Tensor<D> hooke = mu * (h + h.transpose()) + (K - 2 * mu / 3) * h.trace() * Tensor<D>::Identity();
  EXPECT_LE((stress - hooke).norm(), 1e-6 * hooke.norm());
}
TEST(NeoHooke, SmallStrainsHaveTheModuli) {
  small_strains_have_the_moduli<2>();
  small_strains_have_the_moduli<3>();
}

template <int D>
void rotations_turn_the_stress() {
  const Tensor<D> one = Tensor<D>::Identity(), f = one + some_gradient<D>(), r = rotation<D>(1.1);
  EXPECT_LE(neo_hooke<D>(r - one, K, mu).first_piola.norm(), 1e-15 * 8 * K);
  const auto turned = neo_hooke<D>(r * f - one, K, mu), straight = neo_hooke<D>(f - one, K, mu);
  EXPECT_LE((turned.first_piola - r * straight.first_piola).norm(), 1e-14 * K);
  EXPECT_NEAR(turned.energy, straight.energy, 1e-14 * K);
  const Tensor<D> kirchhoff = straight.first_piola * f.transpose();  // symmetric: no torque
  EXPECT_LE((kirchhoff - kirchhoff.transpose()).norm(), 1e-14 * K);
  EXPECT_NEAR(straight.volume_change, f.determinant() - 1, 1e-15);
}
TEST(NeoHooke, RotationsTurnTheStress) {
  rotations_turn_the_stress<2>();
  rotations_turn_the_stress<3>();
}

TEST(NeoHooke, ThePlaneIsSpaceWithoutStrainAcross) {
  const Tensor<2> h = some_gradient<2>();
  Tensor<3> h3 = Tensor<3>::Zero();
  h3.topLeftCorner<2, 2>() = h;
  const auto plane = neo_hooke<2>(h, K, mu);
  const auto space = neo_hooke<3>(h3, K, mu);
  EXPECT_LE((space.first_piola.topLeftCorner<2, 2>() - plane.first_piola).norm(), 1e-15 * K);
  EXPECT_NEAR(space.energy, plane.energy, 1e-15 * K);
}

// St. Venant-Kirchhoff gives way at 0.58 of the length.
TEST(NeoHooke, DoesNotSoftenUnderCompression) {
  double last = 0;
  for (double stretch = 1; stretch > 0.3; stretch -= 0.01) {
    Tensor<3> h = Tensor<3>::Zero();
    h(0, 0) = stretch - 1;
    const double stress = neo_hooke<3>(h, K, mu).first_piola(0, 0);
    EXPECT_LE(stress, last);
    EXPECT_LE(stress, (stretch - 1) * K);
    last = stress;
  }
}

}  // namespace
