// Conduction in fluids that do not move, against exact solutions: decay of a sine, layers of different conductivity, and
// fronts of freezing after Neumann (Carslaw & Jaeger 1959, 11.2) and in a dyke (Turcotte & Schubert 2002, 4.19).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "accuracy/heat_strip.hpp"
#include "accuracy/measure.hpp"
#include "accuracy/pinned.hpp"
#include "sph/laws/enthalpy.hpp"
#include "sph/output/monitors.hpp"

namespace {

using namespace sph;
using measure::across, measure::fluid, measure::for_each, measure::strip, measure::wall;

double rate_of_decay(int cells, double jitter) {
  const decomp::Comm comm(MPI_COMM_SELF);
  constexpr double k = 2 * std::numbers::pi;
  Simulation s = strip(comm, {.cells = cells,
                              .jitter = jitter,
                              .walls = false,
                              .materials = fluid("rock", "{ specific_heat = 1, conductivity = 1 }"),
                              .group = [](double) { return "rock"; },
                              .temperature = [](double x) { return 1 + 0.5 * std::sin(k * x); }});
  const auto amplitude = [&] {
    double sum = 0;
    for_each(s, [&](double x, double t, double, double, unsigned) { sum += t * std::sin(k * x); });
    return sum;
  };
  const double first = amplitude();
  measure::run_until(s, 0.02);
  return std::log(first / amplitude()) / s.global().time / (k * k);
}

TEST(Heat, SineDecays) {
  EXPECT_NEAR(PINNED(rate_of_decay(40, 0.05)), 1, 0.007);
  const double coarse = PINNED(rate_of_decay(20, 0)), fine = PINNED(rate_of_decay(80, 0));
  EXPECT_GT(std::log2((1 - coarse) / (1 - fine)) / 2, 1.9);  // order
}

// The steady state of two layers from the exact one on; c k is the same in both, so that time steps stay long.
void look_at_layers(double ratio, double& flux, double& kink) {
  const decomp::Comm comm(MPI_COMM_SELF);
  const double exact = 1 / (0.5 + 0.5 / ratio), between = 1 - 0.5 * exact;
  const std::string r = std::to_string(ratio);
  Simulation s = strip(
      comm, {.cells = 40,
             .materials = fluid("slow", "{ specific_heat = 1, conductivity = 1 }") +
                          fluid("quick", "{ specific_heat = " + r + ", conductivity = " + r + " }") +
                          wall("left", "temperature = 2") + wall("right", "temperature = 1"),
             .group = [](double x) { return x < 0.5 ? "slow" : "quick"; },
             .temperature = [=](double x) { return x < 0.5 ? 2 - exact * x : 1 + (1 - x) * exact / ratio; }});
  const Monitors monitors(s);
  measure::run_until(s, 0.25);
  double before = 0, after = 0;  // heat from the left wall alone: of particles near it
  const auto from_left = [&] {
    double sum = 0;
    const Particles& p = s.particles();
    for (std::size_t i = 0; i < p.owned(); ++i)
      if (s.scale().metres(p.data<Field::position>()[2 * i]) < 0.5) sum += p.data<Field::heat_inflow>()[i];
    return sum / (across * s.scene().start.spacing);
  };
  before = from_left();
  const double begin = s.global().time;
  measure::run_until(s, 0.35);
  after = from_left();
  flux = (after - before) / (s.global().time - begin) / exact;
  // Where straight fits of both layers, away from walls and kink, meet it.
  double n = 0, sx = 0, st = 0, sxx = 0, sxt = 0;
  for_each(s, [&](double x, double t, double, double, unsigned) {
    if (x < 0.1 || x > 0.4) return;
    n += 1, sx += x, st += t, sxx += x * x, sxt += x * t;
  });
  const double slope = (n * sxt - sx * st) / (n * sxx - sx * sx);
  kink = st / n + slope * (0.5 - sx / n) - (1 + between);
}

TEST(Heat, LayersConductWhatTheirMeanSays) {
  for (const double ratio : {10.0, 1000.0}) {
    double flux = 0, kink = 0;
    look_at_layers(ratio, flux, kink);
    EXPECT_NEAR(measure::pinned(("flux " + std::to_string(static_cast<int>(ratio))).c_str(), flux), 1, 0.005);
    EXPECT_NEAR(measure::pinned(("kink " + std::to_string(static_cast<int>(ratio))).c_str(), kink), 0, 0.005);
  }
}

// Melt at theta above its melting point, frozen by a wall 1 below it: Ste = 2.5, theta = 0.2. The exact front is sharp;
// that of a material which freezes over a range lies where the middle of that range is.
void freeze(int cells, const std::vector<std::string>& set, double& behind, double& error) {
  const decomp::Comm comm(MPI_COMM_SELF);
  constexpr double lambda = 0.708645, theta = 0.2, first = 0.0025, last = 0.04, melting = 10;
  const auto exact = [](double x, double t) {
    const double xi = x / (2 * std::sqrt(t));
    return melting + (xi < lambda ? -1 + std::erf(xi) / std::erf(lambda)
                                  : theta - theta * std::erfc(xi) / std::erfc(lambda));
  };
  const HeatMaterial melt{1, 1, 0.4, melting - 0.01, melting + 0.01};
  Simulation s = strip(
      comm, {.cells = cells,
             .materials = fluid("melt",
                                "{ specific_heat = 1, conductivity = 1, latent_heat = 0.4, solidus = 9.99, "
                                "liquidus = 10.01 }") +
                          wall("left", "temperature = 9") + wall("right", "temperature = 10.2"),
             .group = [](double) { return "melt"; },
             .temperature = [&](double x) { return exact(x, first); },
             .set = set});
  measure::run_until(s, last - first);
  const double t = first + s.global().time, front = 2 * lambda * std::sqrt(t), dx = 1.0 / cells;
  double frozen = 0, sum = 0, n = 0;
  for_each(s, [&](double x, double temp, double h, double mass, unsigned) {
    const double low = enthalpy(melt, melt.solidus), high = enthalpy(melt, melt.liquidus);
    frozen += mass * std::clamp((high - h) / (high - low), 0.0, 1.0);
    sum += std::abs(temp - exact(x, t));
    n += 1;
  });
  behind = (frozen / (across * dx) - front) / dx;
  error = sum / n;
}

TEST(Heat, FreezesAsNeumannHasIt) {
  double behind = 0, error = 0;
  freeze(40, {}, behind, error);
  EXPECT_NEAR(PINNED(behind), 0, 0.2);
  EXPECT_LT(PINNED(error), 0.005);
  freeze(80, {}, behind, error);
  EXPECT_NEAR(measure::pinned("behind, 80", behind), 0, 0.2);
  EXPECT_LT(measure::pinned("error, 80", error), 0.002);
}

// In steps of 8 (32) times the explicit limit, half (two) of the time in which the front passes a spacing.
TEST(Heat, FreezesImplicitlyAsNeumannHasIt) {
  for (const double steps : {8.0, 32.0}) {
    double behind = 0, error = 0;
    const std::string dt = std::to_string(steps * 0.25e6 / 80 / 80) + "e-6";
    freeze(80, {"terms.implicit_conduction=true", "time.dt=" + dt}, behind, error);
    const std::string name = std::to_string(static_cast<int>(steps)) + " limits";
    EXPECT_NEAR(measure::pinned(("behind, " + name).c_str(), behind), 0, 0.2);
    EXPECT_LT(measure::pinned(("error, " + name).c_str(), error), 0.01);
  }
}

// A dyke two metres wide at its melting point in cold rock: nine tenths of it are frozen after 0.81 of the time that
// all of it takes.
TEST(Heat, ADykeFreezes) {
  const decomp::Comm comm(MPI_COMM_SELF);
  constexpr double days = 86400, lambda = 0.73052, kappa = 5e-7, half = 1;
  const double expected = 0.81 * half * half / (4 * kappa * lambda * lambda);
  const std::string rock = "specific_heat = 1200, conductivity = 1.5";
  const HeatMaterial melt{1200, 1.5, 320e3, 1295, 1300};
  Simulation s = strip(
      comm,
      {.cells = 200,
       .length = 10,
       .walls = false,
       .materials =
           fluid("rock", "{ " + rock + " }", 2500) +
           fluid("melt", "{ " + rock + ", latent_heat = 320e3, solidus = 1295, liquidus = 1300 }", 2500),
       .group = [](double x) { return std::abs(x - 5) < half ? "melt" : "rock"; },
       .temperature = [](double x) { return std::abs(x - 5) < half ? 1300.0 : 300.0; }});
  const auto liquid = [&] {
    double sum = 0, all = 0;
    const double low = enthalpy(melt, melt.solidus), high = enthalpy(melt, melt.liquidus);
    for_each(s, [&](double, double, double h, double mass, unsigned g) {
      if (s.scene().groups[g].name != "melt") return;
      all += mass;
      sum += mass * std::clamp((h - low) / (high - low), 0.0, 1.0);
    });
    return sum / all;
  };
  while (liquid() > 0.1 && s.global().time < 30 * days) s.step();
  EXPECT_NEAR(PINNED(s.global().time / expected), 1, 0.01);
}

// What walls give and what there is: closed to rounding.
TEST(Heat, IsAccountedFor) {
  const decomp::Comm comm(MPI_COMM_SELF);
  Simulation s = strip(comm, {.cells = 12,
                              .materials = fluid("rock", "{ specific_heat = 1, conductivity = 1 }") +
                                           wall("left", "heat_flux = 3") + wall("right", "temperature = 1"),
                              .group = [](double) { return "rock"; },
                              .temperature = [](double x) { return 1 + x * x; }});
  const Monitors monitors(s);
  const std::vector<double> first = monitors.values(s);
  for (int k = 0; k < 5000; ++k) s.step();
  const std::vector<double> last = monitors.values(s);
  EXPECT_EQ(first[0], last[0]);
  EXPECT_NEAR((last[1] - last[2]) / first[1], 1, 1e-12);
  // At rest: a straight line with that slope.
  double error = 0;
  for_each(s, [&](double x, double t, double, double, unsigned) {
    error = std::max(error, std::abs(t - (1 + 3 * (1 - x))));
  });
  EXPECT_LT(PINNED(error / 3), 0.03);
}

}  // namespace
