// Vessels of grains in a melt that stands still: the fronts of batch settling (Kynch 1952), and how much faster it clears
// in a vessel that leans (Boycott 1920).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "accuracy/measure.hpp"
#include "accuracy/pinned.hpp"
#include "sph/step/simulation.hpp"

namespace {

using sph::Field;

constexpr double diameter = 0.4, grain = std::numbers::pi / 6 * diameter * diameter * diameter;
constexpr double alone = diameter * diameter / 18;  // Stokes' speed [m/s]

const decomp::Comm& self() {
  static const decomp::Comm comm(MPI_COMM_SELF);
  return comm;
}

// Cells of 1 m of melt with 1 Pa s and 1 kg/m^3, random grains of 2; no melt slips along the sides.
const std::string base = R"(
contact = {law = "linear", largest_overlap = 0.5}
drag.law = "richardson_zaki"
time = {steps = 1, dt = 20}
start.region = [{group = "melt"}]
[[group]]
name = "melt"
kind = "melt"
density = 1
viscosity = 1
[[group]]
name = "crystal"
kind = "grain"
density = 2
diameter = 0.4
normal_stiffness = 15
)";

/// 16 m along x and y, periodic along y and, if it is `open`, along x; grains take about `share` of it; g = 1 m/s^2.
sph::Scene vessel(int height, double share, bool open, const std::string& gravity) {
  constexpr double spacing = 0.5;
  const std::string upper = "[16, 16, " + std::to_string(height) + "]";
  std::string walls, sides;
  const auto add_side = [&](const std::string& name, const std::string& point, const std::string& normal) {
    walls +=
        "{name = \"" + name + "\", material = \"crystal\", point = " + point + ", normal = " + normal + "}, ";
    sides += "{side = \"" + name + "\", slip = false}, ";
  };
  add_side("z0", "[0, 0, 0]", "[0, 0, 1]");
  add_side("z1", upper, "[0, 0, -1]");
  if (!open) add_side("x0", "[0, 0, 0]", "[1, 0, 0]");
  if (!open) add_side("x1", upper, "[-1, 0, 0]");
  const std::string grains = "{group = \"crystal\", lower = [0, 0, 0], upper = " + upper +
                             ", spacing = 0.5, jitter = 0.05, occupied = " +
                             std::to_string(share * spacing * spacing * spacing / grain) + "}";
  return sph::parse_scene(base, "vessel",
                          {"domain={lower = [0, 0, 0], upper = " + upper + ", periodic = [" +
                               (open ? "true" : "false") + ", true, false], gravity = " + gravity + "}",
                           "melt={cells = " + upper + ", side = [" + sides + "]}", "wall=[" + walls + "]",
                           "start.grains=[" + grains + "]"});
}

/// Of the grains' centres, in bins of half a cell over height.
std::vector<double> fractions(const sph::Simulation& s) {
  const sph::Particles& p = s.particles(s.grains()->set());
  std::vector<double> out(32);
  for (std::size_t i = 0; i < p.owned(); ++i) {
    const double z = s.scale().metres(p.data<Field::position>()[3 * i + 2] - s.scale().origin[2]);
    out[std::min<std::size_t>(static_cast<std::size_t>(std::max(z, 0.0) * 2), out.size() - 1)] += grain / 128;
  }
  return out;
}

/// Height at which the fraction, from the floor upwards, first falls below `level`.
double height_of(const std::vector<double>& f, double level) {
  for (std::size_t k = 1; k < f.size(); ++k)
    if (f[k - 1] >= level && f[k] < level)
      return 0.25 + 0.5 * (static_cast<double>(k - 1) + (f[k - 1] - level) / (f[k - 1] - f[k]));
  return 0;
}

/// Least squares.
double slope(const std::vector<double>& x, const std::vector<double>& y) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t k = 0; k < x.size(); ++k, ++n)
    sx += x[k], sy += y[k], sxx += x[k] * x[k], sxy += x[k] * y[k];
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

/// Steps until the next flow.
void flow(sph::Simulation& s) {
  do s.step();
  while (s.global().flow.left > 0);
}

// Where grains are as many as at the start they fall with v, the bed grows at v phi / (phi_m - phi): a shock, as the chord of
// the flux lies below it.
TEST(Settling, FrontsOfABatch) {
  constexpr int height = 16;
  constexpr double loose = 0.55;  // a bed, whichever
  sph::Simulation s(self(), vessel(height, 0.15, true, "[0, 0, -1]"));
  const double phi = static_cast<double>(s.particles(s.grains()->set()).owned()) * grain / (16 * 16 * height);
  const double v = alone * std::pow(1 - phi, 4.65);
  std::vector<double> t, top, bed;
  while (s.global().time < 9 / v) {
    flow(s);
    if (s.global().time < 3 / v) continue;
    const std::vector<double> f = fractions(s);
    t.push_back(s.global().time);
    bed.push_back(height_of(f, 0.5 * (phi + loose)));
    std::vector<double> down(f.rbegin(), f.rend());
    for (double& x : down) x = -x;
    top.push_back(height - height_of(down, -0.5 * phi));
  }
  const std::vector<double> last = fractions(s);
  double packed = 0;  // well inside the bed, without what the floor makes of it
  for (std::size_t k = 1; k < 4; ++k) packed += last[k] / 3;
  const double front = -slope(t, top) / v, rise = slope(t, bed) / (v * phi / (packed - phi));
  std::printf("batch: phi = %.3f, front %.3f of v, bed of %.3f rises %.3f of v phi / (phi_m - phi)\n", phi,
              front, packed, rise);
  EXPECT_NEAR(PINNED(front), 1, 0.05);
  EXPECT_NEAR(PINNED(rise), 1, 0.05);
}

// Ponder (1925), Nakamura & Kuroda (1937): in a vessel of width b and length H that leans by an angle the clear melt grows by
// v (b cos + H sin) a metre of depth, since it comes from below the whole upper wall.
TEST(Settling, AVesselThatLeans) {
  sph::Simulation s(self(), vessel(28, 0.1, false, "[-0.7071067811865476, 0, -0.7071067811865476]"));
  const sph::Particles& p = s.particles(s.grains()->set());
  const double phi = static_cast<double>(p.owned()) * grain / (16 * 16 * 28),
               v = alone * std::pow(1 - phi, 4.65);
  const double expected = v * (16 + 28) * std::numbers::sqrt2 / 2;
  std::vector<double> t, clear;
  while (true) {
    flow(s);
    std::vector<double> column(16 * 28);
    for (std::size_t i = 0; i < p.owned(); ++i) {
      const auto cell = [&](std::size_t a, double most) {
        const double x = s.scale().metres(p.data<Field::position>()[3 * i + a] - s.scale().origin[a]);
        return static_cast<std::size_t>(std::clamp(x, 0.0, most));
      };
      column[cell(2, 27) * 16 + cell(0, 15)] += grain / 16;
    }
    double area = 0;
    for (const double f : column) area += f < 0.5 * phi ? 1 : 0;
    if (area > 0.4 * 16 * 28) break;
    if (area < 0.1 * 16 * 28) continue;
    t.push_back(s.global().time);
    clear.push_back(area);
  }
  const double rate = slope(t, clear) / expected;
  std::printf("a vessel that leans by 45 degrees: phi = %.3f, clears at %.3f of Ponder's rate\n", phi, rate);
  EXPECT_NEAR(PINNED(rate), 1, 0.2);
}

}  // namespace
