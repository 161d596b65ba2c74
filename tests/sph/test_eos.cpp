#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "sph/laws/eos/bubbly.hpp"
#include "sph/laws/eos/ideal_gas.hpp"

namespace {

using sph::BubblyEos;

struct Magma {
  double rho0 = 1250, k = 1e10, m = 1e-3, rt = 5e5, ps = 1e9, gamma = 1;
  BubblyEos eos() const { return {rho0, k, m, rt, ps, gamma}; }

  /// Ida eqs. (12)-(15) as printed, in long double.
  [[nodiscard]] long double density(long double p) const {
    const long double liquid = rho0 * (1 + p / k), gas = p / rt;
    const long double xi = (m - std::pow(p / ps, static_cast<long double>(gamma))) / (1 + m);
    return xi > 0 ? liquid / (1 + xi * (liquid / gas - 1)) : liquid;
  }
  [[nodiscard]] long double bisect(double rho) const {
    const long double p_sat = ps * std::pow<long double>(m, 1 / static_cast<long double>(gamma));
    if (rho >= rho0 * (1 + p_sat / k)) return k * (static_cast<long double>(rho) - rho0) / rho0;
    long double low = 1e-30L, high = p_sat;
    while (high - low > 1e-18L * high) {
      const long double middle = (high > 2 * low) ? std::sqrt(low * high) : (low + high) / 2;
      if (middle <= low || middle >= high) break;
      (density(middle) < rho ? low : high) = middle;
    }
    return (low + high) / 2;
  }
};

struct Row {
  double p, rho, psi, c;
};

void expect_rows(const BubblyEos& eos, std::initializer_list<Row> rows) {
  for (const Row& row : rows) {
    EXPECT_NEAR(eos.density(row.p), row.rho, 6e-12 * row.rho) << row.p;
    EXPECT_NEAR(eos.void_fraction(row.p), row.psi, 6e-10) << row.p;
    EXPECT_NEAR(eos.sound_speed(row.p), row.c, 3e-6 * row.c) << row.p;
    EXPECT_NEAR(eos.pressure(row.rho), row.p, 1e-9 * row.p * (row.psi > 0 ? 1 : 1e4)) << row.p;
  }
}

// Values of Ida's eqs. (12)-(15) computed with 40 digits.
TEST(BubblyEos, TableOfStates) {
  expect_rows(Magma{.rho0 = 1250}.eos(), {{1e3, 2.00079951741, 0.998400958, 22.3629},
                                          {1e4, 19.9005935729, 0.984095287, 22.4836},
                                          {1e5, 188.865358836, 0.849045070, 23.6910},
                                          {2e5, 357.481615599, 0.714248982, 25.0335},
                                          {3e5, 508.927156796, 0.593155194, 26.3770},
                                          {5e5, 769.786838918, 0.384508911, 29.0676},
                                          {7e5, 986.411293598, 0.211162686, 31.7633},
                                          {9e5, 1169.11458926, 0.064885925, 34.4644},
                                          {9.99e5, 1249.34520356, 0.000624673, 35.8037},
                                          {1e6, 1250.125, 0, 2828.427},
                                          {2e6, 1250.25, 0, 2828.43},
                                          {1e7, 1251.25, 0, 2828.43}});
  expect_rows(Magma{.rho0 = 2500}.eos(), {{1e3, 2.00240047865, 0.999199839, 22.3450},
                                          {1e4, 20.0601187933, 0.991983896, 22.3048},
                                          {1e5, 204.284213437, 0.918360600, 21.9028},
                                          {2e5, 417.070821459, 0.833308335, 21.4565},
                                          {3e5, 638.892128757, 0.744629521, 21.0107},
                                          {5e5, 1111.99983337, 0.555444472, 20.1204},
                                          {7e5, 1628.86671633, 0.348694174, 19.2319},
                                          {9e5, 2195.75554952, 0.121864555, 18.3450},
                                          {9.99e5, 2497.13051654, 0.001248567, 17.9066},
                                          {1e6, 2500.25, 0, 2000},
                                          {2e6, 2500.5, 0, 2000},
                                          {1e7, 2502.5, 0, 2000}});
  EXPECT_NEAR(Magma{.rho0 = 1250}.eos().sound_speed(1e6 * (1 - 1e-9)), 35.8172, 1e-4);
  EXPECT_NEAR(Magma{.rho0 = 2500}.eos().sound_speed(1e6 * (1 - 1e-9)), 17.9021, 1e-4);
  EXPECT_DOUBLE_EQ(Magma{}.eos().saturation_pressure(), 1e6);
}

TEST(BubblyEos, TableOfInverses) {
  const BubblyEos light = Magma{.rho0 = 1250}.eos(), heavy = Magma{.rho0 = 2500}.eos();
  const double accepted = 3e-14;
  for (auto [rho, p] : {std::pair{250., 134992.74309184},
                        {625., 384224.25343849},
                        {1000., 713790.03008054},
                        {1187.5, 922026.82761524},
                        {1248.75, 998237.22777951},
                        {1250., 999839.65087379}})
    EXPECT_NEAR(light.pressure(rho), p, accepted * p);
  for (auto [rho, p] : {std::pair{500., 237878.38749821},
                        {1250., 555185.34293432},
                        {2000., 833055.47460748},
                        {2500., 999919.87675024}})
    EXPECT_NEAR(heavy.pressure(rho), p, accepted * p);
  EXPECT_NEAR(light.pressure(1e-3), 0.4995, 1e-6);
}

TEST(BubblyEos, FragmentationPressures) {
  const auto pressure_at = [](const BubblyEos& eos, double psi) {
    double low = 1, high = 1e6;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      (eos.void_fraction(middle) > psi ? low : high) = middle;
    }
    return low;
  };
  const BubblyEos light = Magma{.rho0 = 1250}.eos(), heavy = Magma{.rho0 = 2500}.eos();
  EXPECT_NEAR(pressure_at(light, 0.5), 384533.49, 0.006);
  EXPECT_NEAR(pressure_at(light, 0.7), 211235.93, 0.006);
  EXPECT_NEAR(pressure_at(light, 0.8), 135120.92, 0.006);
  EXPECT_NEAR(pressure_at(heavy, 0.5), 555432.16, 0.006);
  EXPECT_NEAR(pressure_at(heavy, 0.7), 348765.93, 0.006);
  EXPECT_NEAR(pressure_at(heavy, 0.8), 238056.38, 0.006);
}

TEST(BubblyEos, InverseAgainstBisection) {
  double worst = 0;
  int most = 0;
  for (const Magma& magma :
       {Magma{}, Magma{.rho0 = 2500}, Magma{.rho0 = 2500, .m = 0.01},
        Magma{.rho0 = 2500, .k = 2.5e7, .m = 0.01},
        Magma{.rho0 = 2500, .m = 0.02, .ps = 5.9e10, .gamma = 0.5}, Magma{.rho0 = 2500, .gamma = 0.5},
        Magma{.rho0 = 2500, .gamma = 0.7}, Magma{.rho0 = 2500, .m = 0.03, .gamma = 0.7},
        Magma{.rho0 = 2500, .gamma = 1.5}, Magma{.rho0 = 2500, .m = 1e-4, .gamma = 1.5}}) {
    const BubblyEos eos = magma.eos();
    const double rho_sat = eos.density(eos.saturation_pressure());
    std::mt19937_64 engine(7);
    for (int k = 0; k < 400; ++k) {
      const double u = static_cast<double>(engine() >> 11) * 0x1p-53;
      double rho = u * rho_sat * 1.1;  // the whole range, then thin gas, then the edge of saturation
      if (k % 4 == 1) rho = rho_sat * std::pow(1e-8, u);
      if (k % 4 == 2) rho = rho_sat * (1 - std::pow(1e-15, u));
      const long double p = magma.bisect(rho);
      const double error = static_cast<double>(std::abs((eos.pressure(rho) - p) / p));
      ASSERT_LE(error, 1e-12) << "rho " << rho << " gamma " << magma.gamma << " m " << magma.m;
      ASSERT_LE(eos.iterations(rho), 4) << "rho " << rho << " gamma " << magma.gamma << " m " << magma.m;
      worst = std::max(worst, error);
      most = std::max(most, eos.iterations(rho));
    }
  }
  RecordProperty("worst_error", std::to_string(worst * 1e15) + "e-15");
  RecordProperty("most_iterations", most);
}

TEST(BubblyEos, RoundTripAndSoundSpeed) {
  for (double gamma : {0.5, 0.7, 1.0, 1.5}) {
    const Magma magma{.gamma = gamma};
    const BubblyEos eos = magma.eos();
    const double p_sat = eos.saturation_pressure();
    for (double p = 1e2; p < 1e8; p *= 1.07) {
      // In the liquid, density itself resolves pressure no finer than K times its own rounding.
      EXPECT_NEAR(eos.pressure(eos.density(p)), p, p < p_sat ? 1e-10 * p : 4e-16 * magma.k);
      const long double d = 1e-8L * p;
      const long double slope = 2 * d / (magma.density(p + d) - magma.density(p - d));
      const double c = p < p_sat ? static_cast<double>(std::sqrt(slope)) : std::sqrt(magma.k / magma.rho0);
      EXPECT_NEAR(eos.sound_speed(p), c, 1e-9 * c) << p << " " << gamma;
    }
  }
}

TEST(BubblyEos, ContinuousAndRisingAcrossSaturation) {
  for (double gamma : {0.5, 0.7, 1.0, 1.5}) {
    const BubblyEos eos = Magma{.gamma = gamma}.eos();
    const double p_sat = eos.saturation_pressure(), rho_sat = eos.density(p_sat);
    double rho = rho_sat, below = eos.pressure(rho_sat);
    EXPECT_NEAR(below, p_sat, 1e-6 * p_sat);
    for (int k = 0; k < 50; ++k) {
      rho = std::nextafter(rho, 0.0);
      const double p = eos.pressure(rho);
      EXPECT_LE(p, below + 4e-16 * 1e10);
      EXPECT_NEAR(p, p_sat, 1e-6 * p_sat);
      below = p;
    }
    double last = 0;
    for (double x = 1e-6; x < 1.2 * rho_sat; x *= 1.003) {
      const double p = eos.pressure(x);
      ASSERT_GT(p, last);
      last = p;
    }
  }
}

TEST(BubblyEos, FiniteForEveryPositiveDensity) {
  for (double gamma : {0.3, 0.5, 0.7, 1.0, 1.5, 3.0}) {
    const BubblyEos eos = Magma{.gamma = gamma}.eos();
    for (double rho = std::numeric_limits<double>::denorm_min(); rho < 1e290; rho *= 3) {
      const double p = eos.pressure(rho);
      ASSERT_TRUE(std::isfinite(p)) << rho << " " << gamma;
      ASSERT_GE(p, 0) << rho << " " << gamma;
      ASSERT_TRUE(rho < 1e-300 || p > 0) << rho << " " << gamma;
      ASSERT_TRUE(std::isfinite(eos.density(p)) && std::isfinite(eos.sound_speed(p)));
      ASSERT_GT(eos.sound_speed(p), 0);
      ASSERT_GE(eos.void_fraction(p), 0);
      ASSERT_LE(eos.void_fraction(p), 1);
      ASSERT_LE(eos.iterations(rho), 10) << rho << " " << gamma;
    }
    for (double p : {0.0, -1e5}) {  // no state of the gas: its limit
      EXPECT_EQ(eos.density(p), 0);
      EXPECT_EQ(eos.void_fraction(p), 1);
      EXPECT_NEAR(eos.sound_speed(p), std::sqrt(5e2 / 1.001), 1e-9);
    }
    EXPECT_EQ(eos.pressure(-1.0), 0);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(std::isnan(eos.pressure(nan)) && std::isnan(eos.density(nan)) &&
                std::isnan(eos.void_fraction(nan)) && std::isnan(eos.sound_speed(nan)));
  }
}

TEST(BubblyEos, WithoutGasIsTheLinearOne) {
  const BubblyEos eos(2500, 1e10, 0, 0, 0, 1);
  EXPECT_EQ(eos.saturation_pressure(), 0);
  for (double rho : {2400.0, 2499.0, 2500.0, 2501.0, 2600.0}) {
    EXPECT_NEAR(eos.pressure(rho), 1e10 * (rho / 2500 - 1), 1e-5);
    EXPECT_NEAR(eos.density(eos.pressure(rho)), rho, 1e-12 * rho);
    EXPECT_EQ(eos.void_fraction(eos.pressure(rho)), 0);
    EXPECT_EQ(eos.sound_speed(eos.pressure(rho)), 2000);
    EXPECT_EQ(eos.iterations(rho), 0);
  }
  EXPECT_LT(eos.pressure(2499.0), 0);  // tension
  EXPECT_TRUE(std::isnan(eos.pressure(std::numeric_limits<double>::quiet_NaN())));
}

TEST(BubblyEos, RefusesWhatHasNoInverse) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((Magma{.rho0 = 0}.eos()), sph::InputError);
  EXPECT_THROW((Magma{.k = -1}.eos()), sph::InputError);
  EXPECT_THROW((Magma{.m = -1e-3}.eos()), sph::InputError);
  EXPECT_THROW((Magma{.m = nan}.eos()), sph::InputError);
  EXPECT_THROW((Magma{.rt = 0}.eos()), sph::InputError);
  EXPECT_THROW((Magma{.ps = 0}.eos()), sph::InputError);
  EXPECT_THROW((Magma{.gamma = 0}.eos()), sph::InputError);
  EXPECT_THROW((Magma{.m = 0.9, .ps = 1e10}.eos()), sph::InputError);  // gas denser than the liquid
}

TEST(BubblyEos, BitsAreTheRecordedOnes) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (double gamma : {0.5, 0.7, 1.0, 1.5}) {
    const BubblyEos eos = Magma{.rho0 = 2500, .m = 0.004, .gamma = gamma}.eos();
    for (int k = 1; k <= 250; ++k) {
      const double p = eos.pressure(10.3 * k);
      for (double x : {p, eos.density(p), eos.void_fraction(p), eos.sound_speed(p)})
        hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0x100000001b3u;
    }
  }
  EXPECT_EQ(hash, 0x6e90144571983e55u) << std::hex << hash;
}

TEST(IdealGas, PressureEnergyAndSound) {
  const sph::IdealGas air{1.4};
  const double u = air.energy(1e5, 1.2);
  EXPECT_NEAR(air.pressure(1.2, u), 1e5, 1e-9);
  EXPECT_NEAR(air.sound_speed(u), std::sqrt(1.4 * 1e5 / 1.2), 1e-10);
}

TEST(IdealGas, CompressionIsAdiabaticToSecondOrderAndReversible) {
  for (const double gamma : {1.001, 1.4, 5.0 / 3.0, 3.0}) {
    const sph::IdealGas gas{gamma};
    EXPECT_EQ(gas.compressed(2.5, 1), 2.5);
    double error[2];
    for (int fine : {0, 1}) {
      const int steps = fine == 1 ? 80 : 40;
      double u = 1;
      for (int k = 0; k < steps; ++k) u = gas.compressed(u, std::pow(2.0, 1.0 / steps));
      error[fine] = u / std::pow(2.0, gamma - 1) - 1;
      for (int k = 0; k < steps; ++k) u = gas.compressed(u, std::pow(0.5, 1.0 / steps));
      EXPECT_NEAR(u, 1, 1e-13);
    }
    EXPECT_NEAR(error[0] / error[1], 4, 0.05) << gamma;
    EXPECT_LT(std::abs(error[1]), 2e-4) << gamma;
  }
  EXPECT_LT((sph::IdealGas{1.4}.compressed(1, 0.1)), 0);  // no step may be as long: a guard ends the run
}

// Eight particles at a time have the bits of each alone, and of all that follows: contents from none to more than the law can
// hold but for a little, densities from nothing to above saturation, the ends of a row of particles.
TEST(BubblyEos, OfManyParticlesIsThatOfEach) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform;
  for (const double gamma : {1.0, 0.5, 0.7}) {
    sph::Group g;
    g.density = 2400;
    g.eos.bulk_modulus = 1e9;
    g.bubbly.gas_content = 0.02;
    g.bubbly.gas_rt = 5e5;
    g.bubbly.solubility_pressure = gamma == 1 ? 1e9 : 5.92e10;
    g.bubbly.solubility_exponent = gamma;
    constexpr std::size_t n = 4003;
    std::vector<double> rho(n), m(n), found(3 * n);
    for (std::size_t i = 0; i < n; ++i) {
      m[i] = i % 50 == 0 ? 0 : i % 3 == 0 ? 0.02 : std::pow(10, -12 + 11 * uniform(random));
      rho[i] = i % 70 == 0
                   ? -1
                   : 2400 * (i % 2 == 0 ? std::pow(10, -7 * uniform(random)) : 0.9 + 0.2 * uniform(random));
      if (i % 31 == 0 && m[i] > 0)
        rho[i] = bubbly_eos(g, m[i]).density(bubbly_eos(g, m[i]).saturation_pressure() *
                                             (1 - 1e-15 * static_cast<double>(i % 7)));
    }
    const sph::EosRows rows{rho.data(),           m.data(), nullptr, nullptr, found.data(), found.data() + n,
                            found.data() + 2 * n, 1e5};
    for (const auto& [first, last] : {std::pair<std::size_t, std::size_t>{0, n}, {3, 4}, {5, 16}, {17, 30}}) {
      std::fill(found.begin(), found.end(), -7.0);
      sph::BubblyMagma::derive(g, rows, first, last);
      for (std::size_t i = 0; i < n; ++i) {
        const BubblyEos eos = bubbly_eos(g, m[i]);
        const bool in = i >= first && i < last;
        const double p = eos.pressure(rho[i]);
        ASSERT_EQ(std::bit_cast<std::uint64_t>(found[i]), std::bit_cast<std::uint64_t>(in ? p - 1e5 : -7))
            << rho[i] << ' ' << m[i];
        ASSERT_EQ(std::bit_cast<std::uint64_t>(found[n + i]),
                  std::bit_cast<std::uint64_t>(in ? eos.sound_speed(p) : -7));
        ASSERT_EQ(std::bit_cast<std::uint64_t>(found[2 * n + i]),
                  std::bit_cast<std::uint64_t>(in ? eos.void_fraction(p) : -7));
      }
    }
  }
}

}  // namespace
