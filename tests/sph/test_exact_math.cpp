#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "decomp/splitmix.hpp"
#include "sph/core/exact_math.hpp"

namespace {

/// Uniform in [low, high) without a library whose bits could vary.
double uniform(std::uint64_t counter, double low, double high) {
  return low + (high - low) * decomp::splitmix_unit(decomp::splitmix(counter * decomp::splitmix_stride));
}

double error_in_ulp(double got, long double want) {
  const double size = std::abs(static_cast<double>(want));
  const double ulp = std::nextafter(size, std::numeric_limits<double>::infinity()) - size;
  return static_cast<double>(std::abs(got - want) / ulp);
}

TEST(ExactMath, WithinTwoUlp) {
  double worst_pow = 0, worst_exp = 0, worst_log = 0, worst_sin = 0, worst_cos = 0;
  const auto keep = [](double& worst, double error) { worst = std::max(worst, error); };
  for (std::uint64_t k = 0; k < 20000; ++k) {
    const double x = std::exp2(uniform(4 * k, -60, 60)), y = uniform(4 * k + 1, -6, 6);
    const double e = uniform(4 * k + 2, -700, 700), angle = uniform(4 * k + 3, -100, 100);
    keep(worst_pow, error_in_ulp(sph::exact_pow(x, y), std::pow<long double>(x, y)));
    keep(worst_exp, error_in_ulp(sph::exact_exp(e), std::exp(static_cast<long double>(e))));
    keep(worst_log, error_in_ulp(sph::exact_log(x), std::log(static_cast<long double>(x))));
    keep(worst_sin, error_in_ulp(sph::exact_sin(angle), std::sin(static_cast<long double>(angle))));
    keep(worst_cos, error_in_ulp(sph::exact_cos(angle), std::cos(static_cast<long double>(angle))));
  }
  EXPECT_LE(worst_pow, 2);
  EXPECT_LE(worst_exp, 2);
  EXPECT_LE(worst_log, 2);
  EXPECT_LE(worst_sin, 2);
  EXPECT_LE(worst_cos, 2);
  RecordProperty("worst_pow", std::to_string(worst_pow));
  RecordProperty("worst_exp", std::to_string(worst_exp));
  RecordProperty("worst_log", std::to_string(worst_log));
  RecordProperty("worst_sin", std::to_string(worst_sin));
  RecordProperty("worst_cos", std::to_string(worst_cos));
}

// A CPU, compiler or library that gives other bits changes the hash. If a new SLEEF does so, every recorded
// fingerprint of a scene with a general solubility exponent changes with it: say so in the release notes.
TEST(ExactMath, BitsAreTheRecordedOnes) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  const auto fold = [&](double x) { hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0x100000001b3u; };
  for (std::uint64_t k = 0; k < 200; ++k) {
    const double x = uniform(5 * k, 1e-9, 10), y = uniform(5 * k + 1, 0.1, 3);
    fold(sph::exact_pow(x, y));
    fold(sph::exact_exp(uniform(5 * k + 2, -50, 50)));
    fold(sph::exact_log(uniform(5 * k + 3, 1e-9, 1e9)));
    const double angle = uniform(5 * k + 4, -20, 20);
    fold(sph::exact_sin(angle));
    fold(sph::exact_cos(angle));
  }
  EXPECT_EQ(hash, 0xa3a7d87eaf958967u) << std::hex << hash;
}

TEST(ExactMath, SpecialValues) {
  const double inf = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(sph::exact_pow(0.0, 0.7), 0.0);
  EXPECT_EQ(sph::exact_pow(1.0, 123.4), 1.0);
  EXPECT_EQ(sph::exact_pow(3.0, 2.0), 9.0);
  EXPECT_EQ(sph::exact_exp(0.0), 1.0);
  EXPECT_EQ(sph::exact_exp(-inf), 0.0);
  EXPECT_EQ(sph::exact_log(1.0), 0.0);
  EXPECT_EQ(sph::exact_log(0.0), -inf);
  EXPECT_EQ(sph::exact_sin(0.0), 0.0);
  EXPECT_EQ(sph::exact_cos(0.0), 1.0);
  EXPECT_TRUE(std::isnan(sph::exact_pow(nan, 0.7)));
  EXPECT_TRUE(std::isnan(sph::exact_pow(-1.0, 0.7)));
  EXPECT_TRUE(std::isnan(sph::exact_exp(nan)));
  EXPECT_TRUE(std::isnan(sph::exact_log(-1.0)));
  EXPECT_TRUE(std::isnan(sph::exact_sin(nan)));
  EXPECT_TRUE(std::isnan(sph::exact_cos(inf)));
}

}  // namespace
