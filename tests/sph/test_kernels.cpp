#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "sph/core/kernels.hpp"

namespace {

// A stand-in for the SIMD classes: found by argument-dependent lookup, as the real one has to be.
namespace lanes {
template <class T, int N>
struct Pack {
  std::array<T, N> x{};
  constexpr Pack() = default;
  explicit constexpr Pack(T scalar) { x.fill(scalar); }
  template <class Op>
  static constexpr Pack each(Pack a, Pack b, Op op) {
    Pack r;
    for (int i = 0; i < N; ++i) r.x[i] = op(a.x[i], b.x[i]);
    return r;
  }
  friend constexpr Pack operator+(Pack a, Pack b) {
    return each(a, b, [](T s, T t) { return s + t; });
  }
  friend constexpr Pack operator-(Pack a, Pack b) {
    return each(a, b, [](T s, T t) { return s - t; });
  }
  friend constexpr Pack operator*(Pack a, Pack b) {
    return each(a, b, [](T s, T t) { return s * t; });
  }
};
template <class T, int N>
constexpr Pack<T, N> max(Pack<T, N> a, Pack<T, N> b) {
  return Pack<T, N>::each(a, b, [](T s, T t) { return s < t ? t : s; });
}
}  // namespace lanes

template <class K, int D>
struct Case {
  using Kernel = K;
  static constexpr int dim = D;
};

template <class T>
struct Kernels : ::testing::Test {};

using sph::Quintic, sph::WendlandC2, sph::WendlandC4;
using Cases = ::testing::Types<Case<Quintic, 1>, Case<Quintic, 2>, Case<Quintic, 3>, Case<WendlandC2, 1>,
                               Case<WendlandC2, 2>, Case<WendlandC2, 3>, Case<WendlandC4, 1>,
                               Case<WendlandC4, 2>, Case<WendlandC4, 3>>;
TYPED_TEST_SUITE(Kernels, Cases);

/// Composite 5-point Gauss-Legendre on [0, radius]: the panels end on the knots of the spline.
template <class F>
double integrate(double radius, F f) {
  constexpr std::array<double, 3> node{0.0, 0.5384693101056831, 0.9061798459386640};
  constexpr std::array<double, 3> weight{0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  const int panels = 16 * static_cast<int>(radius);
  const double half = radius / (2 * panels);
  double sum = 0;
  for (int k = 0; k < panels; ++k) {
    const double middle = (2 * k + 1) * half;
    sum += weight[0] * f(middle);
    for (int i : {1, 2}) sum += weight[i] * (f(middle - half * node[i]) + f(middle + half * node[i]));
  }
  return sum * half;
}

TYPED_TEST(Kernels, IntegralIsOne) {
  using K = typename TypeParam::Kernel;
  constexpr int dim = TypeParam::dim;
  constexpr double sphere = dim == 1 ? 2 : (dim == 2 ? 2 : 4) * std::numbers::pi;
  const double integral = integrate(K::radius, [](double q) {
    return sphere * (dim == 1 ? 1 : (dim == 2 ? q : q * q)) * K::template value<dim>(q);
  });
  EXPECT_NEAR(integral * K::template normalisation<dim>, 1, 1e-12);
}

TYPED_TEST(Kernels, SlopeIsTheDerivative) {
  using K = typename TypeParam::Kernel;
  constexpr int dim = TypeParam::dim;
  const double w0 = K::template value<dim>(0.0), eps = 1e-5;
  for (double q = 0.001; q < K::radius + 0.5; q += 0.0037) {
    const double difference = (K::template value<dim>(q + eps) - K::template value<dim>(q - eps)) / (2 * eps);
    EXPECT_NEAR(K::template slope<dim>(q), difference, 1e-8 * w0) << q;
  }
}

TYPED_TEST(Kernels, DecreasesAndIsPositiveInside) {
  using K = typename TypeParam::Kernel;
  constexpr int dim = TypeParam::dim;
  for (double q = 0.01; q < K::radius - 1e-3; q += 0.01) {
    EXPECT_GT(K::template value<dim>(q), 0) << q;
    EXPECT_LT(K::template slope<dim>(q), 0) << q;
  }
}

template <class K, int D, class T>
void expect_zeros() {
  const T radius = static_cast<T>(K::radius);
  EXPECT_EQ((K::template slope<D>(T(0))), T(0));
  EXPECT_EQ((K::template value<D>(radius)), T(0));
  EXPECT_EQ((K::template slope<D>(radius)), T(0));
  for (T q = radius; q < std::numeric_limits<T>::max() / 2; q *= T(1.7)) {
    EXPECT_EQ((K::template value<D>(q)), T(0)) << q;
    EXPECT_EQ((K::template slope<D>(q)), T(0)) << q;
  }
  EXPECT_EQ((K::template slope<D>(std::numeric_limits<T>::max())), T(0));
  EXPECT_EQ((K::template value<D>(std::numeric_limits<T>::max())), T(0));
  const T nan = std::numeric_limits<T>::quiet_NaN();
  EXPECT_TRUE(std::isnan(K::template value<D>(nan)));
  EXPECT_TRUE(std::isnan(K::template slope<D>(nan)));
}

TYPED_TEST(Kernels, ZeroOutsideAndAtTheCentre) {
  expect_zeros<typename TypeParam::Kernel, TypeParam::dim, double>();
  expect_zeros<typename TypeParam::Kernel, TypeParam::dim, float>();
}

TYPED_TEST(Kernels, FloatAgreesWithDouble) {
  using K = typename TypeParam::Kernel;
  constexpr int dim = TypeParam::dim;
  const double w0 = K::template value<dim>(0.0);
  for (float q = 0; q < static_cast<float>(K::radius) + 0.5f; q += 0.003f) {
    EXPECT_NEAR(K::template value<dim>(q), K::template value<dim>(static_cast<double>(q)), 4e-6 * w0) << q;
    EXPECT_NEAR(K::template slope<dim>(q), K::template slope<dim>(static_cast<double>(q)), 4e-6 * w0) << q;
  }
}

TYPED_TEST(Kernels, LanesAgreeWithScalarsBitForBit) {
  using K = typename TypeParam::Kernel;
  constexpr int dim = TypeParam::dim;
  using V = lanes::Pack<float, 4>;
  for (int k = 0; k < 1000; ++k) {
    V q;
    for (int i = 0; i < 4; ++i) q.x[i] = static_cast<float>(4 * k + i) * 0.001f;
    const V w = K::template value<dim>(q), s = K::template slope<dim>(q);
    for (int i = 0; i < 4; ++i) {
      ASSERT_EQ(w.x[i], (K::template value<dim>(q.x[i])));
      ASSERT_EQ(s.x[i], (K::template slope<dim>(q.x[i])));
    }
  }
}

// The textbook forms that the header quotes, w(0) = 1.
TEST(KernelForms, MatchTheLiterature) {
  for (double q = 0; q < 2; q += 0.01) {
    const double t = 1 - q / 2;
    EXPECT_NEAR(WendlandC2::value<1>(q) / 16, std::pow(t, 3) * (1 + 1.5 * q), 1e-14);
    EXPECT_NEAR(WendlandC2::value<2>(q) / 16, std::pow(t, 4) * (1 + 2 * q), 1e-14);
    EXPECT_NEAR(WendlandC4::value<1>(q) / 64, std::pow(t, 5) * (1 + 2.5 * q + 2 * q * q), 1e-14);
    EXPECT_NEAR(WendlandC4::value<3>(q) / 768, std::pow(t, 6) * (1 + 3 * q + 35. / 12 * q * q), 1e-13);
  }
  EXPECT_DOUBLE_EQ(16 * WendlandC2::normalisation<2>, 7 / (4 * std::numbers::pi));
  EXPECT_DOUBLE_EQ(16 * WendlandC2::normalisation<3>, 21 / (16 * std::numbers::pi));
  EXPECT_DOUBLE_EQ(768 * WendlandC4::normalisation<2>, 9 / (4 * std::numbers::pi));
  EXPECT_DOUBLE_EQ(768 * WendlandC4::normalisation<3>, 495 / (256 * std::numbers::pi));
  static_assert(Quintic::value<2>(0.0) == 66.0 && Quintic::slope<2>(0.0) == 0.0);
}

}  // namespace
