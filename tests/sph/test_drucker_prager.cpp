#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "sph/laws/drucker_prager.hpp"

namespace {

using sph::StrengthConstants;

constexpr double K = 1e10, G = 6e9, degree = std::numbers::pi / 180;

StrengthConstants constants(double phi, double psi, double tension, bool plane) {
  return {std::sin(phi * degree), std::cos(phi * degree), std::sin(psi * degree), 1e6, tension, K, G, plane};
}

TEST(DruckerPrager, Cones) {
  const auto cone = [](double phi, bool plane) {
    return drucker_prager_cone(constants(phi, 0, 1e300, plane));
  };
  EXPECT_NEAR(cone(30, false).slope, 0.230940, 1e-6);
  EXPECT_NEAR(cone(30, false).limit, 1.2e6, 1);
  EXPECT_NEAR(cone(20, false).slope, 0.148583, 1e-6);
  EXPECT_NEAR(cone(20, false).limit, 1.224686e6, 1);
  EXPECT_NEAR(cone(30, true).slope, 0.160128, 1e-6);
  EXPECT_NEAR(cone(30, true).limit, 0.832050e6, 1);
  EXPECT_NEAR(cone(35, true).slope, 0.181499, 1e-6);
  EXPECT_NEAR(cone(35, true).limit, 0.777623e6, 1);
}

// In the plane of sqrt(J2)/sqrt(G) and I1/(3 sqrt(K)) the elastic energy is a distance: walk along the surface.
TEST(DruckerPrager, IsTheNearestStressOfAll) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> mean_of(-8e6, 8e6), shear_of(0, 8e6);
  int cone_only = 0, corner = 0, cap_only = 0;
  for (int n = 0; n < 3000; ++n) {
    const double phi = std::array{10.0, 20.0, 35.0}[n % 3],
                 tension = std::array{2e5, 8e5, 1e300}[n % 2 + n % 3 / 2];
    const StrengthConstants k = constants(phi, phi, tension, n % 2 == 0);
    const sph::DruckerPragerCone cone = drucker_prager_cone(k);
    const double cap = std::min(tension, cone.limit / (3 * cone.slope)), mean = mean_of(random),
                 shear = shear_of(random);
    const sph::ConeReturn end = return_to_drucker_prager(k, shear, mean);
    const sph::ConeReturn twice = return_to_drucker_prager(k, end.shear, end.mean);
    EXPECT_EQ(twice.shear, end.shear);
    EXPECT_EQ(twice.mean, end.mean);
    EXPECT_GE(end.shear, 0);
    EXPECT_LE(end.shear + 3 * cone.slope * end.mean - cone.limit, 1e-12 * 1e7);
    EXPECT_LE(end.mean, cap * (1 + 1e-12));
    const bool inside = shear + 3 * cone.slope * mean <= cone.limit && mean <= cap;
    if (inside) {
      EXPECT_EQ(end.shear, shear);
      EXPECT_EQ(end.mean, mean);
      continue;
    }
    const auto away = [&](double q, double m) {
      return (q - shear) * (q - shear) / G + (m - mean) * (m - mean) / K;
    };
    double least = 1e300;
    for (int step = 0; step <= 20000; ++step) {
      const double m = cap - 2e7 * step / 20000;
      least = std::min(least, away(cone.limit - 3 * cone.slope * m, m));
      least = std::min(least, away((cone.limit - 3 * cone.slope * cap) * step / 20000, cap));
    }
    EXPECT_LE(away(end.shear, end.mean), least * (1 + 1e-9) + 1e-9);
    const bool on_cap = end.mean >= cap * (1 - 1e-12),
               on_cone = end.shear >= (cone.limit - 3 * cone.slope * end.mean) - 1;
    (on_cap && on_cone ? corner : on_cap ? cap_only : cone_only) += 1;
    EXPECT_NEAR(end.plastic_shear, (shear - end.shear) / G, 1e-15);
    EXPECT_NEAR(end.plastic_volume, (mean - end.mean) / K, 1e-15);
    EXPECT_GE(end.plastic_volume, 0);
  }
  EXPECT_GT(cone_only, 50);
  EXPECT_GT(corner, 50);
  EXPECT_GT(cap_only, 50);
}

}  // namespace
