// Walls that take heat by a coefficient and by radiation, against exact solutions: slabs at rest between such a wall and a
// kept temperature, and a half space that one begins to cool (Carslaw & Jaeger 1959, 2.7).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "accuracy/heat_strip.hpp"
#include "accuracy/pinned.hpp"
#include "sph/output/monitors.hpp"

namespace {

using namespace sph;
using measure::across, measure::fluid, measure::for_each, measure::strip, measure::wall;

constexpr double conductivity = 50, hot = 1000, length = 1;  // kappa = 1
const std::string rock = fluid("rock", "{ specific_heat = 50, conductivity = 50 }");

/// Of a face at T: what the wall takes is what comes through the slab.
double face_of(const std::function<double(double)>& taken) {
  double cold = 0, warm = hot;
  for (int k = 0; k < 100; ++k) {
    const double t = 0.5 * (cold + warm);
    (taken(t) < conductivity * (hot - t) / length ? cold : warm) = t;
  }
  return cold;
}

/// The largest error of T, over the fall of T, and the flux from the warm wall over the exact one.
void look_at_slab(const std::string& right, const std::function<double(double)>& taken, double& error,
                  double& flux) {
  const decomp::Comm comm(MPI_COMM_SELF);
  const double fall = hot - face_of(taken), exact = conductivity * fall / length;
  const auto at = [=](double x) { return hot - fall * x / length; };
  Simulation s = strip(comm, {.cells = 40,
                              .materials = rock + wall("left", "temperature = 1000") + wall("right", right),
                              .group = [](double) { return "rock"; },
                              .temperature = at});
  const Monitors monitors(s);
  const std::vector<double> first = monitors.values(s);
  measure::run_until(s, 0.3);
  const auto from_left = [&] {
    double sum = 0;
    const Particles& p = s.particles();
    for (std::size_t i = 0; i < p.owned(); ++i)
      if (s.scale().metres(p.data<Field::position>()[2 * i]) < 0.5) sum += p.data<Field::heat_inflow>()[i];
    return sum / (across * s.scene().start.spacing);
  };
  const double before = from_left(), begin = s.global().time;
  measure::run_until(s, 0.4);
  flux = (from_left() - before) / (s.global().time - begin) / exact;
  error = 0;
  for_each(s, [&](double x, double t, double, double, unsigned) {
    error = std::max(error, std::abs(t - at(x)) / fall);
  });
  const std::vector<double> last = monitors.values(s);
  EXPECT_NEAR((last[1] - last[2]) / first[1], 1, 1e-12);
}

constexpr double sigma = 5.670374419e-8;
double fourth(double t) { return t * t * (t * t); }

TEST(WallHeat, ByACoefficient) {
  double error = 0, flux = 0;
  look_at_slab(
      "heat_transfer = { coefficient = 150, temperature = 400 }", [](double t) { return 150 * (t - 400); },
      error, flux);
  EXPECT_LT(PINNED(error), 0.005);
  EXPECT_NEAR(PINNED(flux), 1, 0.005);
}

TEST(WallHeat, ByRadiation) {
  double error = 0, flux = 0;
  look_at_slab(
      "radiation = { emissivity = 0.8, temperature = 300 }",
      [](double t) { return 0.8 * sigma * (fourth(t) - fourth(300)); }, error, flux);
  EXPECT_LT(PINNED(error), 0.005);
  EXPECT_NEAR(PINNED(flux), 1, 0.005);
}

TEST(WallHeat, ByBoth) {
  double error = 0, flux = 0;
  look_at_slab(
      "heat_transfer = { coefficient = 20, temperature = 300 }\nradiation = { emissivity = 1, temperature = "
      "500 }",
      [](double t) { return 20 * (t - 300) + sigma * (fourth(t) - fourth(500)); }, error, flux);
  EXPECT_LT(PINNED(error), 0.005);
  EXPECT_NEAR(PINNED(flux), 1, 0.005);
}

// However large the coefficient, the step is the same, and the wall is one that keeps its temperature.
TEST(WallHeat, IsKeptByLargeCoefficients) {
  double error = 0, flux = 0;
  look_at_slab(
      "heat_transfer = { coefficient = 1e12, temperature = 400 }", [](double t) { return 1e12 * (t - 400); },
      error, flux);
  EXPECT_LT(PINNED(error), 0.005);
  EXPECT_NEAR(PINNED(flux), 1, 0.005);
}

// u = erfc(x / 2 sqrt(kappa t)) - exp(h x + h^2 kappa t) erfc(x / 2 sqrt(kappa t) + h sqrt(kappa t)), h = h_c / k.
TEST(WallHeat, CoolsAHalfSpace) {
  const decomp::Comm comm(MPI_COMM_SELF);
  constexpr double h = 8;
  Simulation s = strip(
      comm, {.cells = 40,
             .materials = rock + wall("left", "heat_transfer = { coefficient = 400, temperature = 300 }") +
                          wall("right", ""),
             .group = [](double) { return "rock"; },
             .temperature = [](double) { return hot; }});
  measure::run_until(s, 0.02);
  const double root = std::sqrt(s.global().time);
  double error = 0, n = 0;
  for_each(s, [&](double x, double t, double, double, unsigned) {
    const double xi = x / (2 * root),
                 u = std::erfc(xi) - std::exp(h * x + h * h * root * root) * std::erfc(xi + h * root);
    error += std::abs(t - (hot - 700 * u)) / 700;
    n += 1;
  });
  EXPECT_LT(PINNED(error / n), 0.002);
}

}  // namespace
