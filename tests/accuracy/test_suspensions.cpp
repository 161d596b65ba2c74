// Grains in melts: one of them against Stokes and Hasimoto (1959), many at random against Richardson & Zaki (1954), a layer
// of them that falls against a melt as heavy and as thick.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "accuracy/measure.hpp"
#include "accuracy/pinned.hpp"
#include "sph/output/monitors.hpp"

namespace {

using sph::Field;

const decomp::Comm& alone() {
  static const decomp::Comm comm(MPI_COMM_SELF);
  return comm;
}

/// A cube of `cells` cells of 1 m, periodic, of melt with 1 Pa s and 1 kg/m^3, grains of 2; g = 1 m/s^2 downwards.
std::string cube(int cells, const std::string& diameter, const std::string& fill, const std::string& more) {
  const std::string n = std::to_string(cells);
  return "contact.law = \"linear\"\ndomain = {lower = [0, 0, 0], upper = [" + n + ", " + n + ", " + n +
         "], periodic = [true, true, true], gravity = [0, 0, -1]}\nstart.region = [{group = \"melt\"}]\n"
         "start.grains = [{group = \"crystal\", " +
         fill + "}]\n" + more + "melt.cells = [" + n + ", " + n + ", " + n +
         "]\n[[group]]\nname = \"melt\"\nkind = \"melt\"\ndensity = 1\nviscosity = 1\n"
         "[[group]]\nname = \"crystal\"\nkind = \"grain\"\ndensity = 2\nnormal_stiffness = 2.5\ndiameter = " +
         diameter + "\n";
}

/// Of the speed downwards over that of each grain alone.
double mean_share_of_stokes(const sph::Simulation& s) {
  const sph::Particles& p = s.particles(s.grains()->set());
  double sum = 0;
  for (std::size_t i = 0; i < p.owned(); ++i) {
    const double d = 2 * p.data<Field::radius>()[i];
    sum -= p.data<Field::velocity>()[3 * i + 2] / (d * d / 18);
  }
  return sum / static_cast<double>(p.owned());
}

double fraction(const sph::Simulation& s, double volume) {
  const sph::Particles& p = s.particles(s.grains()->set());
  double sum = 0;
  for (std::size_t i = 0; i < p.owned(); ++i) sum += std::pow(2 * p.data<Field::radius>()[i], 3);
  return std::numbers::pi / 6 * sum / volume;
}

TEST(Suspensions, OneGrain) {
  for (const double d : {0.1, 0.3, 0.5}) {
    double worst = 0;
    for (int k = 0; k < 20; ++k) {
      // Places spread over a cell by the golden ratio and its kin.
      std::string lower, upper;
      for (const double step : {0.8191725, 0.6710436, 0.5497005}) {
        const double at = 7.5 + std::fmod(step * (k + 1), 1.0);
        lower += (lower.empty() ? "" : ", ") + std::to_string(at);
        upper += (upper.empty() ? "" : ", ") + std::to_string(at + 1);
      }
      const std::string fill = "lower = [" + lower + "], upper = [" + upper + "], spacing = 1";
      sph::Simulation s(alone(), sph::parse_scene(cube(16, std::to_string(d), fill,
                                                       "melt.tolerance = 1e-6\ndrag.law = \"stokes\"\n"
                                                       "time.steps = 1\n"),
                                                  "one", {}));
      s.step();
      const double expected = 1 - 2.837 * 0.5 * d / 16;
      worst = std::max(worst, std::fabs(mean_share_of_stokes(s) / expected - 1));
    }
    EXPECT_LT(PINNED(worst), 0.03);
  }
}

/// The mean speed over Richardson and Zaki's while grains fall by 20 times their width, in a cube of 12 cells a side of whose
/// lattice of `along` places a side they take the share `taken` at random. From a whole lattice, whose order holds the melt
/// up, it takes 100 widths until grains of several sizes have lost their places: 0.84 at first, 1.01 at last (phi = 0.05).
double hindered(int along, double taken, const std::string& diameter) {
  const double spacing = 12.0 / along;
  const std::string fill = "lower = [0, 0, 0], upper = [12, 12, 12], spacing = " + std::to_string(spacing) +
                           ", jitter = 0.01, occupied = " + std::to_string(taken);
  constexpr double alone_for_its_width = 0.5 / (0.25 / 18);  // [s]
  sph::Simulation s(alone(), sph::parse_scene(cube(12, diameter, fill,
                                                   "drag.law = \"richardson_zaki\"\ntime.steps = 1\n"
                                                   "time.dt = 20\n"),
                                              "many", {"start.seed=1"}));
  double sum = 0;
  int n = 0;
  while (s.global().time < 30 * alone_for_its_width) {
    s.step();
    if (s.global().time < 10 * alone_for_its_width || s.global().flow.left > 0) continue;
    sum += mean_share_of_stokes(s);
    ++n;
  }
  const double phi = fraction(s, 12 * 12 * 12), speed = sum / n / std::pow(1 - phi, 4.65);
  std::printf("hindered settling: phi = %.3f, %.3f of Richardson and Zaki\n", phi, speed);
  return speed;
}

TEST(Suspensions, HinderedSettling) {
  for (const double taken : {0.15, 0.3, 0.6, 0.9, 1.0}) {
    const double speed = taken < 1 ? hindered(24, taken, "[0.35, 0.5]") : hindered(25, taken, "[0.4, 0.47]");
    EXPECT_NEAR(PINNED(speed), 1, 0.05);
  }
}

/// The rate at which the flow's speed grows, between 1.5 and 3 times its first [1/s].
double growth(const sph::Scene& scene) {
  sph::Simulation s(alone(), scene);
  const sph::Monitors monitors(s);
  constexpr std::size_t speed = 2;
  s.step();
  const double first = monitors.values(s)[speed];
  double from = 0, from_speed = 0;
  while (true) {
    s.step();
    const double now = monitors.values(s)[speed];
    if (from == 0 && now > 1.5 * first) {
      from = s.global().time;
      from_speed = now;
    }
    if (now > 3 * first) return std::log(now / from_speed) / (s.global().time - from);
  }
}

// 25 grains deep, beside a melt of the density and the viscosity of the mixture (granular Rayleigh-Taylor).
TEST(Suspensions, ALayerFallsLikeAMeltAsHeavy) {
  const std::string frame =
      "domain = {lower = [0, 0, 0], upper = [1, 0.5, 1], periodic = [true, true, false], gravity = [0, 0, "
      "-1]}\n"
      "melt.cells = [28, 16, 28]\ntime.steps = 1\nmonitor = [{kind = \"melt\"}]\n"
      "[[group]]\nname = \"melt\"\nkind = \"melt\"\ndensity = 1\nviscosity = 1\n";
  constexpr double d = 0.0125, spacing = 0.02;
  const double phi = std::numbers::pi / 6 * std::pow(d / spacing, 3);
  const std::string of_grains =
      "contact.law = \"linear\"\ndrag.law = \"richardson_zaki\"\ntime.dt = 2\nstart.region = [{group = "
      "\"melt\"}]\n"
      "start.grains = [{group = \"crystal\", lower = [0, 0, 0.46], upper = [0.5, 0.5, 1], spacing = 0.02},"
      " {group = \"crystal\", lower = [0.5, 0, 0.54], upper = [1, 0.5, 1], spacing = 0.02}]\n" +
      frame +
      "[[group]]\nname = \"crystal\"\nkind = \"grain\"\ndensity = 2\nnormal_stiffness = 1e-3\ndiameter = "
      "0.0125\n";
  const std::string of_melts =
      "dimension = 3\ntime.dt = 2\nstart.region = [{group = \"melt\"},"
      " {group = \"layer\", shape = \"box\", lower = [0, 0, 0.46], upper = [0.5, 0.5, 1]},"
      " {group = \"layer\", shape = \"box\", lower = [0.5, 0, 0.54], upper = [1, 0.5, 1]}]\n" +
      frame + "[[group]]\nname = \"layer\"\nkind = \"melt\"\ndensity = " + std::to_string(1 + phi) +
      "\nviscosity = " + std::to_string(1 + 2.5 * phi / (1 - phi / 0.585)) + "\n";
  const double grains = growth(sph::parse_scene(of_grains, "grains", {}));
  const double melts = growth(sph::parse_scene(of_melts, "melts", {}));
  std::printf("a layer of grains falls at %.3f of the rate of a melt as heavy, %.4g 1/s\n", grains / melts,
              melts);
  EXPECT_NEAR(PINNED(grains / melts), 1, 0.1);
}

}  // namespace
