// A crack with a straight front is the same in three dimensions as in two: the row of cracks of test_cracks.cpp, as deep as a
// period of cells, whose tips bear the same share of their strength and which open as far.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "accuracy/pinned.hpp"
#include "accuracy/slab.hpp"

namespace {

constexpr double period = 21, rise = 63, until = 2 * rise;

struct Crack {
  double tip = 0, opening = 0;
};

Crack pressed(int dim) {
  const decomp::Comm comm(MPI_COMM_SELF);
  const std::string z = dim == 3 ? ", 0" : "", top = dim == 3 ? ", 11" : "";
  const auto corners = [&](double x, double y) {
    return "lower = [" + std::to_string(-x) + ", " + std::to_string(-y) + z + "]\nupper = [" +
           std::to_string(x) + ", " + std::to_string(y) + top + "]\n";
  };
  sph::Simulation s(comm, sph::parse_scene("dimension = " + std::to_string(dim) + "\n[domain]\n" +
                                               corners(40.5, period / 2) + "periodic = [false, true" +
                                               (dim == 3 ? ", true" : "") + R"(]
[kernel]
h_over_dx = 1
)" + measure::rock_and_melt + R"([start]
spacing = 1
[[start.region]]
group = "none"
[[start.region]]
group = "rock"
shape = "box"
)" + corners(11.5, period / 2) + "[[start.region]]\ngroup = \"melt\"\nshape = \"box\"\n" +
                                               corners(0.5, 5.5) + "[[reset]]\n" + corners(40, period) +
                                               "pressure = 1e-3\nrise_time = " + std::to_string(rise) +
                                               "\n[time]\ncfl = 0.8\nuntil = " + std::to_string(until) + "\n",
                                           "crack", {}));
  const auto d = static_cast<std::size_t>(dim);
  Crack out;
  double weights = 0;
  measure::run_until(s, until, [&] {
    if (s.global().time < rise) return;
    const double w = 1 - std::cos(2 * std::numbers::pi * (s.global().time - rise) / (until - rise));
    const sph::Particles& p = s.particles();
    const std::int64_t *x = p.data<sph::Field::position>(), *u = p.data<sph::Field::displacement>();
    double beyond = -1;
    std::array<double, 2> moved{}, number{};
    for (std::size_t i = 0; i < p.owned(); ++i) {
      beyond = std::max(beyond, p.data<sph::Field::overload>()[i]);
      const double by = s.scale().metres(u[d * i]) - s.scale().metres(0);
      const double at = s.scale().metres(x[d * i]) - by, along = s.scale().metres(x[d * i + 1]);
      if (std::abs(along) > 0.3 || std::abs(std::abs(at) - 1) > 0.1) continue;
      moved[at > 0] += by;
      number[at > 0] += 1;
    }
    out.tip += w * (beyond + 1);
    out.opening += w * (moved[1] / number[1] - moved[0] / number[0]);
    weights += w;
  });
  return {out.tip / weights, out.opening / weights};
}

TEST(CracksInSpace, WithStraightFrontsAreThoseOfAPlane) {
  const Crack plane = pressed(2), space = pressed(3);
  const double tip = space.tip / plane.tip, opening = space.opening / plane.opening;
  std::printf("crack in space: its tip bears %.4f of what it does in a plane, it opens by %.4f of it\n", tip,
              opening);
  EXPECT_NEAR(PINNED(tip), 1, 0.02);
  EXPECT_NEAR(PINNED(opening), 1, 0.02);
}

}  // namespace
