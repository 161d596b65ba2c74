// Averages in snapshots beside brute force, of walls too, which look at other walls in no sum.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "output/averages.hpp"
#include "sph/scene/with_kernel.hpp"
#include "sph/step/simulation.hpp"

namespace sph {
namespace {

constexpr const char* channel = R"(
[domain]
lower = [0, 0]
upper = [12, 12]
periodic = [true, false]
gravity = [0, -1]
[kernel]
h_over_dx = 1
[[group]]
name = "melt"
kind = "fluid"
density = 1000
sound_speed = 20
viscosity = 100
[[group]]
name = "floor"
kind = "wall"
[start]
spacing = 1
jitter = 0.2
[[start.region]]
group = "melt"
[[start.region]]
group = "floor"
shape = "box"
lower = [0, 0]
upper = [12, 4]
[[start.region]]
group = "none"
shape = "box"
lower = [0, 10]
upper = [12, 12]
[time]
steps = 5
[output]
average_space = true
)";

TEST(Averages, are_over_all_neighbours_of_a_group) {
  const decomp::Comm self(MPI_COMM_SELF);
  Simulation s(self, parse_scene(channel, "channel", {}));
  for (int k = 0; k < 5; ++k) s.step();
  const std::vector<ExtraColumn> found = averages(s);
  const Particles& p = s.particles();
  const auto* x = p.data<Field::position>();
  const auto* group = p.data<Field::group>();
  const double quanta_per_h = s.scene().kernel.smoothing_length / s.scale().quantum;
  std::size_t walls = 0;
  for (std::size_t i = 0; i < p.owned(); ++i) {
    double shares = 0, pressure = 0, velocity[2] = {};
    for (std::size_t j = 0; j < p.rows(); ++j) {
      if (group[j] != group[i]) continue;
      const double r = std::hypot(static_cast<double>(x[2 * j] - x[2 * i]),
                                  static_cast<double>(x[2 * j + 1] - x[2 * i + 1]));
      const double share = kernel_value(s.scene().kernel.shape, 2, r / quanta_per_h) *
                           p.data<Field::mass>()[j] / p.data<Field::density>()[j];
      shares += share;
      pressure += share * p.data<Field::pressure>()[j];
      for (std::size_t a = 0; a < 2; ++a) velocity[a] += share * p.data<Field::velocity>()[2 * j + a];
    }
    EXPECT_NEAR(found[1].values[i], pressure / shares, 1e-9 * std::fabs(pressure / shares)) << i;
    for (std::size_t a = 0; a < 2; ++a)
      EXPECT_NEAR(found[0].values[2 * i + a], velocity[a] / shares, 1e-9) << i;
    walls += group[i] == 1 ? 1 : 0;
  }
  EXPECT_EQ(walls, 48u);
}

constexpr const char* cavity = R"(
domain = { lower = [0, 0], upper = [16, 16], periodic = [true, true] }
kernel = { h_over_dx = 1.2, largest_growth = 2 }
time = { cfl = 0.5, steps = 20 }
output = { average_space = true }
group = [{ name = "cold", kind = "fluid", eos = "ideal_gas", heat_ratio = 1.4, density = 1, start_pressure = 1 },
         { name = "hot", kind = "fluid", eos = "ideal_gas", heat_ratio = 1.4, density = 1, start_pressure = 100 }]
[start]
spacing = 0.5
jitter = 0.2
region = [{ group = "cold" }, { group = "hot", shape = "ball", centre = [8, 8], radius = 2.5 }]
)";

// Where a gas is squeezed its lists are short.
TEST(Averages, of_gases_do_not_depend_on_the_reach_of_lists) {
  const decomp::Comm self(MPI_COMM_SELF);
  std::map<std::uint64_t, double> wanted;
  for (const char* skin : {"0.3", "0"}) {
    Simulation s(self, parse_scene(cavity, "cavity", {fmt::format("decomposition.skin={}", skin)}));
    for (int k = 0; k < 20; ++k) s.step();
    const Particles& p = s.particles();
    const double* h = p.data<Field::smoothing_length>();
    EXPECT_LT(*std::min_element(h, h + p.owned()), 0.8 * s.scene().kernel.smoothing_length);
    const std::vector<double> pressure = averages(s)[1].values;
    for (std::size_t i = 0; i < p.owned(); ++i) {
      const auto [at, first] = wanted.try_emplace(p.data<Field::id>()[i], pressure[i]);
      EXPECT_EQ(at->second, pressure[i]) << skin << ' ' << i;
    }
  }
}

}  // namespace
}  // namespace sph
