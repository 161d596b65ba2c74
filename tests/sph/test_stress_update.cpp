#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sph/models/stress_update.hpp"

namespace {

using sph::update_deviator, sph::update_hooke_literal;

using Stress2 = std::array<double, 3>;  // xx yy xy
using Stress3 = std::array<double, 6>;  // xx yy zz xy xz yz
using Gradient2 = std::array<double, 4>;
using Gradient3 = std::array<double, 9>;

double second_invariant(const Stress3& s) {
  return s[0] * s[0] + s[1] * s[1] + s[2] * s[2] + 2 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]);
}
double determinant(const Stress3& s) {
  return s[0] * (s[1] * s[2] - s[5] * s[5]) - s[3] * (s[3] * s[2] - s[5] * s[4]) +
         s[4] * (s[3] * s[5] - s[1] * s[4]);
}

// B3: one turn of rigid rotation brings the stress back; without the rotation terms it would never have
// moved.
TEST(UpdateDeviator, OneTurnInThePlane) {
  const double omega = 50, dt = 2e-4;
  const int steps = static_cast<int>(std::lround(2 * std::numbers::pi / (omega * dt)));
  const double exact_dt = 2 * std::numbers::pi / (omega * steps);
  const Stress2 start{3e5, -1e5, 2e5};
  Stress2 s = start;
  const Gradient2 gradient{0, -omega, omega, 0};
  const double invariant = 0.25 * (s[0] - s[1]) * (s[0] - s[1]) + s[2] * s[2];
  for (int n = 0; n < steps; ++n) {
    update_deviator<2>(s.data(), gradient.data(), 6e9, exact_dt);
    if (n == steps / 4 - 1) {  // a quarter: xx and yy change places, xy its sign
      EXPECT_NEAR(s[0], start[1], 0.01 * 3e5);
      EXPECT_NEAR(s[1], start[0], 0.01 * 3e5);
      EXPECT_NEAR(s[2], -start[2], 0.01 * 3e5);
    }
  }
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(s[k], start[k], 1e-3 * 3e5);
  EXPECT_NEAR(s[0] + s[1], start[0] + start[1], 1e-10 * 3e5);
  EXPECT_NEAR(0.25 * (s[0] - s[1]) * (s[0] - s[1]) + s[2] * s[2], invariant, 1e-11 * invariant);
}

TEST(UpdateDeviator, OneTurnAboutASkewAxis) {
  const double omega = 3;
  const int steps = 2000;
  const double dt = 2 * std::numbers::pi / (omega * steps);
  const std::array<double, 3> w{omega * 2 / 7, -omega * 3 / 7, omega * 6 / 7};
  const Gradient3 gradient{0, -w[2], w[1], w[2], 0, -w[0], -w[1], w[0], 0};
  const Stress3 start{3, -1, -2, 2, -0.5, 1.5};
  Stress3 s = start;
  for (int n = 0; n < steps; ++n) update_deviator<3>(s.data(), gradient.data(), 1e3, dt);
  for (int k = 0; k < 6; ++k) EXPECT_NEAR(s[k], start[k], 1e-4);
  EXPECT_NEAR(s[0] + s[1] + s[2], 0, 1e-12);
  EXPECT_NEAR(second_invariant(s), second_invariant(start), 1e-10);
  EXPECT_NEAR(determinant(s), determinant(start), 1e-10);
}

// The Cayley transform is a rotation however large the step is.
TEST(UpdateDeviator, HugeRotationKeepsTheInvariants) {
  const Gradient3 gradient{0, -40, 7, 40, 0, -90, -7, 90, 0};
  const Stress3 start{3, -1, -2, 2, -0.5, 1.5};
  Stress3 s = start;
  for (int n = 0; n < 100; ++n) update_deviator<3>(s.data(), gradient.data(), 1e3, 1.0);
  EXPECT_NEAR(second_invariant(s), second_invariant(start), 1e-11);
  EXPECT_NEAR(determinant(s), determinant(start), 1e-11);
}

// B4: v_x = y; Jaumann's rate gives s_xy = G sin(gamma), s_xx = -s_yy = G (1 - cos(gamma)).
TEST(UpdateDeviator, SimpleShear) {
  const int steps = 1000;
  const double shear_modulus = 6e9, dt = 1.0 / steps;
  const Gradient2 gradient{0, 1, 0, 0};
  Stress2 s{};
  for (int n = 0; n < steps; ++n) update_deviator<2>(s.data(), gradient.data(), shear_modulus, dt);
  EXPECT_NEAR(s[2], 0.841471 * shear_modulus, 0.005 * 0.841471 * shear_modulus);
  EXPECT_NEAR(s[0], 0.459698 * shear_modulus, 0.005 * 0.459698 * shear_modulus);
  EXPECT_NEAR(s[1], -s[0], 1e-12 * shear_modulus);
}

// Uniaxial stretching in plane strain: dev(D) = (2/3, -1/3, -1/3) D_xx, the last implied.
TEST(UpdateDeviator, PlaneStrainDeviator) {
  Stress2 s{};
  update_deviator<2>(s.data(), Gradient2{0.3, 0, 0, 0}.data(), 2.0, 0.5);
  EXPECT_DOUBLE_EQ(s[0], 2 * 2.0 * 0.5 * 0.2);
  EXPECT_DOUBLE_EQ(s[1], -2 * 2.0 * 0.5 * 0.1);
  EXPECT_EQ(s[2], 0);
  Stress2 t{};  // equal stretching of both axes still deviates: s_zz = -(s_xx + s_yy)
  update_deviator<2>(t.data(), Gradient2{0.3, 0, 0, 0.3}.data(), 2.0, 0.5);
  EXPECT_DOUBLE_EQ(t[0], 0.2);
  EXPECT_DOUBLE_EQ(t[1], 0.2);
}

TEST(UpdateDeviator, PlaneEqualsSpace) {
  Stress2 plane{3, -1, 2};
  Stress3 space{3, -1, -2, 2, 0, 0};
  const Gradient2 g{0.3, -1.7, 0.4, -0.2};
  const Gradient3 g3{g[0], g[1], 0, g[2], g[3], 0, 0, 0, 0};
  for (int n = 0; n < 1000; ++n) {
    update_deviator<2>(plane.data(), g.data(), 1.5, 1e-3);
    update_deviator<3>(space.data(), g3.data(), 1.5, 1e-3);
    ASSERT_NEAR(space[0], plane[0], 1e-12);
    ASSERT_NEAR(space[1], plane[1], 1e-12);
    ASSERT_NEAR(space[3], plane[2], 1e-12);
    ASSERT_NEAR(space[2], -(plane[0] + plane[1]), 1e-12);
    ASSERT_EQ(space[4], 0);
    ASSERT_EQ(space[5], 0);
  }
}

// Renaming the axes x -> y -> z -> x renames the result: each of the nine gradients sits where it should.
TEST(UpdateDeviator, NoAxisIsSpecial) {
  const Gradient3 g{0.3, -0.7, 0.4, 0.9, -0.2, 0.6, -0.5, 0.1, 0.8};
  Gradient3 renamed;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) renamed[3 * ((i + 1) % 3) + (j + 1) % 3] = g[3 * i + j];
  const auto rename = [](const Stress3& s) { return Stress3{s[2], s[0], s[1], s[4], s[5], s[3]}; };
  Stress3 s{3, -1, -2, 2, -0.5, 1.5}, t = rename(s), u = s, v = t;
  for (int n = 0; n < 10; ++n) {
    update_deviator<3>(s.data(), g.data(), 1.5, 0.1);
    update_deviator<3>(t.data(), renamed.data(), 1.5, 0.1);
    update_hooke_literal<3>(u.data(), g.data(), 0.7, 1.5, 0.1);
    update_hooke_literal<3>(v.data(), renamed.data(), 0.7, 1.5, 0.1);
  }
  for (int k = 0; k < 6; ++k) {
    EXPECT_NEAR(rename(s)[k], t[k], 1e-12);
    EXPECT_NEAR(rename(u)[k], v[k], 1e-12);
  }
  EXPECT_NEAR(s[0] + s[1] + s[2], 0, 1e-12);
}

TEST(UpdateHookeLiteral, IsEquationEleven) {
  const double lambda = 0.7, mu = 1.5, dt = 0.1;
  const Gradient2 g{0.3, -0.7, 0.4, -0.2};
  Stress2 s{1, 2, 3};
  update_hooke_literal<2>(s.data(), g.data(), lambda, mu, dt);
  EXPECT_NEAR(s[0], 1 + dt * (lambda * 0.1 + 2 * mu * 0.3), 1e-15);
  EXPECT_NEAR(s[1], 2 + dt * (lambda * 0.1 - 2 * mu * 0.2), 1e-15);
  EXPECT_NEAR(s[2], 3 + dt * mu * -0.3, 1e-15);
  const Gradient3 g3{0.3, -0.7, 0.4, 0.9, -0.2, 0.6, -0.5, 0.1, 0.8};
  Stress3 t{};
  update_hooke_literal<3>(t.data(), g3.data(), lambda, mu, dt);
  const Stress3 expected{dt * (lambda * 0.9 + 2 * mu * 0.3),
                         dt * (lambda * 0.9 - 2 * mu * 0.2),
                         dt * (lambda * 0.9 + 2 * mu * 0.8),
                         dt * mu * 0.2,
                         dt * mu * -0.1,
                         dt * mu * 0.7};
  for (int k = 0; k < 6; ++k) EXPECT_NEAR(t[k], expected[k], 1e-15);
}

// The fault that the conservative formulation removes: simple shear gives 1.0 G and no normal stress, and a
// rotating body keeps its stress in the directions of space.
TEST(UpdateHookeLiteral, IsNotObjective) {
  Stress2 s{};
  for (int n = 0; n < 1000; ++n) update_hooke_literal<2>(s.data(), Gradient2{0, 1, 0, 0}.data(), 1, 1, 1e-3);
  EXPECT_NEAR(s[2], 1, 1e-12);
  EXPECT_EQ(s[0], 0);
  Stress2 t{1, 0, 0};
  update_hooke_literal<2>(t.data(), Gradient2{0, -1, 1, 0}.data(), 1, 1, 0.1);
  EXPECT_EQ(t, (Stress2{1, 0, 0}));
}

}  // namespace
