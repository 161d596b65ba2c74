// Dam break: water twice as long as high, H, in a tank of 5.366 H, by gauges. The pressure on the far wall against the experiment of
// Buchner (2002) and the SPH of Marrone et al. (2011, H/dx = 320; 4.5 % above it), over the lower half of the sensor's disc as
// they and Adami et al. (2012) have it; levels against Lobovsky et al. (2014, fig. 16). Times in sqrt(H/g), pressures in rho g H. Walls slip,
// as theirs do.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "accuracy/measure.hpp"
#include "accuracy/pinned.hpp"
#include "sph/output/monitors.hpp"

namespace {

struct Point {
  double t, value;
};

constexpr auto measured_pressure = std::to_array<Point>({{3.2, 0.563},
                                                         {3.37, 0.541},
                                                         {3.52, 0.545},
                                                         {3.68, 0.541},
                                                         {3.9, 0.544},
                                                         {4.06, 0.556},
                                                         {4.22, 0.558},
                                                         {4.36, 0.555},
                                                         {4.57, 0.543},
                                                         {4.72, 0.538},
                                                         {4.82, 0.517},
                                                         {5.04, 0.514}});
constexpr double measured_impact = 2.48;  ///< of the first pressure that is felt
/// At H and 2.883 H from the back.
constexpr auto level_behind = std::to_array<Point>({{1, 0.931},
                                                    {1.5, 0.8535},
                                                    {2, 0.7825},
                                                    {2.5, 0.705},
                                                    {3, 0.632},
                                                    {3.5, 0.568},
                                                    {4, 0.5005},
                                                    {4.5, 0.4515},
                                                    {5, 0.4015}});
constexpr auto level_before = std::to_array<Point>({{1.6, 0.2005},
                                                    {2, 0.216},
                                                    {2.5, 0.247},
                                                    {3, 0.266},
                                                    {3.5, 0.2775},
                                                    {4, 0.2925},
                                                    {4.5, 0.2985},
                                                    {5, 0.2975}});

struct Gauged {
  std::vector<double> t, pressure, behind, before;

  [[nodiscard]] static double at(const std::vector<double>& times, const std::vector<double>& values,
                                 double t) {
    const auto k = static_cast<std::size_t>(std::ranges::lower_bound(times, t) - times.begin());
    const double share = (t - times[k - 1]) / (times[k] - times[k - 1]);
    return values[k - 1] + share * (values[k] - values[k - 1]);
  }
  /// Over a time of 0.2.
  [[nodiscard]] double mean_pressure(double middle) const {
    double sum = 0;
    int n = 0;
    for (std::size_t k = 0; k < t.size(); ++k)
      if (std::abs(t[k] - middle) < 0.1) {
        sum += pressure[k];
        ++n;
      }
    return sum / n;
  }
};

double mean(const std::vector<double>& row, std::size_t first, std::size_t points, std::size_t every) {
  double sum = 0;
  for (std::size_t k = 0; k < points; ++k)
    if (const double p = row[first + k * every]; !std::isnan(p)) sum += p;
  return sum / static_cast<double>(points);
}

Gauged run(double spacing) {
  const decomp::Comm comm(MPI_COMM_SELF);
  constexpr double g = 9.81, density = 1000;
  constexpr std::size_t points = 7;
  const double wall = 5.375, layers = 5 * spacing;
  sph::Simulation s(
      comm,
      sph::read_scene(
          std::string(PEPERITE_ACCURACY_DIR "/dam_break.toml"),
          {fmt::format("start.spacing={}", spacing), fmt::format("start.lower=[{},{}]", -layers, -layers),
           fmt::format("start.upper=[{},4]", wall + layers), "time.until=1.7", "kernel.shape=wendland_c4",
           "kernel.h_over_dx=2", "terms.artificial_viscosity=0.02", "group.wall.slip=true",
           fmt::format(
               "monitor=[{{kind=\"level\", name=\"behind\", at=[1,0]}}, {{kind=\"level\", name=\"before\", "
               "at=[2.8833,0]}}, {{kind=\"gauge\", name=\"wall\", at=[{0},0.1167], to=[{0},0.2667], "
               "points={1}}}]",
               wall, points)}));
  const sph::Monitors monitors(s);
  const auto pressure =
      static_cast<std::size_t>(std::ranges::find(monitors.names(), "wall_1_p") - monitors.names().begin());
  const auto second =
      static_cast<std::size_t>(std::ranges::find(monitors.names(), "wall_2_p") - monitors.names().begin());
  Gauged out;
  for (double t = 0; t < 5.2; t += 0.005) {
    measure::run_until(s, t / std::sqrt(g));
    const std::vector<double> row = monitors.values(s);
    out.t.push_back(s.global().time * std::sqrt(g));
    out.behind.push_back(row[0]);
    out.before.push_back(row[1]);
    out.pressure.push_back(mean(row, pressure, points, second - pressure) / (density * g));
  }
  return out;
}

template <std::size_t N>
double worst(const Gauged& g, const std::vector<double>& level, const std::array<Point, N>& measured) {
  double out = 0;
  for (const Point& p : measured) {
    const double ours = Gauged::at(g.t, level, p.t);
    std::printf("  t = %.2f: level %.4f, measured %.4f\n", p.t, ours, p.value);
    out = std::max(out, std::abs(ours - p.value));
  }
  return out;
}

// The pressure is rough: waves of sound go to and fro in the layer at the wall, which disorder feeds.
TEST(DamBreak, PressesOnTheWallAsMeasured) {
  const Gauged g = run(0.025);
  double ours = 0, theirs = 0, rough = 0;
  for (const Point& p : measured_pressure) {
    const double here = g.mean_pressure(p.t);
    std::printf("  t = %.2f: pressure %.4f, measured %.4f\n", p.t, here, p.value);
    ours += here / measured_pressure.size();
    theirs += p.value / measured_pressure.size();
  }
  int n = 0;
  for (std::size_t k = 0; k < g.t.size(); ++k)
    if (g.t[k] > 3.2 && g.t[k] < 5) {
      rough += std::pow(g.pressure[k] - g.mean_pressure(g.t[k]), 2);
      ++n;
    }
  rough = std::sqrt(rough / n);
  const auto felt = std::ranges::find_if(g.pressure, [](double p) { return p > 0.1; });
  const double impact = g.t[static_cast<std::size_t>(felt - g.pressure.begin())];
  const double behind = worst(g, g.behind, level_behind), before = worst(g, g.before, level_before);
  std::printf(
      "dam break: impact at %.3f, plateau %.4f (measured %.4f), roughness %.4f, levels within %.4f, %.4f H\n",
      impact, ours, theirs, rough, behind, before);
  EXPECT_NEAR(PINNED(impact), measured_impact, 0.1);
  EXPECT_NEAR(PINNED(ours / theirs), 1, 0.1);
  EXPECT_LE(PINNED(rough / ours), 0.3);  // 0.02 in what Marrone et al. print
  EXPECT_LE(PINNED(behind), 0.04);
  EXPECT_LE(PINNED(before), 0.04);
}

}  // namespace
