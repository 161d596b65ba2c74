// Gauges: exact for what is linear in space, on walls and in corners too; levels; what passes a rectangle; the same bits on any number
// of ranks.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "sph/output/monitors.hpp"
#include "sph/scene/scene.hpp"

namespace sph {
namespace {

/// A tank 4 x 4, full to y = 3; jittered, and of three kernels.
std::string tank(const std::string& kernel, const std::string& monitors) {
  return R"(
dimension = 2
[domain]
lower = [-1, -1]
upper = [5, 5]
gravity = [0, -9.81]
[kernel]
)" + kernel +
         R"(
[[group]]
name = "water"
kind = "fluid"
density = 1000
sound_speed = 80
[[group]]
name = "wall"
kind = "wall"
[start]
spacing = 0.1
jitter = 0.2
pressure = "hydrostatic"
surface_height = 3
[[start.region]]
group = "wall"
[[start.region]]
group = "none"
shape = "box"
lower = [0, 0]
upper = [4, 5]
[[start.region]]
group = "water"
shape = "box"
lower = [0, 0]
upper = [4, 3]
[time]
steps = 20
)" + monitors;
}

std::string gauge(const std::string& name, const std::string& at, const std::string& more = "") {
  return "[[monitor]]\nname = \"" + name + "\"\nkind = \"gauge\"\nat = " + at + "\n" + more;
}

double value_of(Simulation& s, const std::string& column) {
  const Monitors monitors(s);
  const auto at = std::ranges::find(monitors.names(), column);
  EXPECT_NE(at, monitors.names().end()) << column;
  return monitors.values(s)[static_cast<std::size_t>(at - monitors.names().begin())];
}

TEST(Gauges, are_exact_for_linear_fields) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  for (const std::string kernel : {"h_over_dx = 1.2", "h_over_dx = 1.6\nshape = \"wendland_c2\"",
                                   "h_over_dx = 1.8\nshape = \"wendland_c4\""}) {
    Simulation s(comm, parse_scene(tank(kernel, gauge("inside", "[2, 1.5]") + gauge("wall", "[4, 1]") +
                                                    gauge("corner", "[0, 0]") + gauge("dry", "[2, 4]")),
                                   "tank", {}));
    auto& p = const_cast<Particles&>(s.particles());
    const auto field = [](double x, double y) { return 500 + 300 * x - 700 * y; };
    for (std::size_t i = 0; i < p.owned(); ++i) {
      const double x = s.scale().metres(p.data<Field::position>()[2 * i]),
                   y = s.scale().metres(p.data<Field::position>()[2 * i + 1]);
      const bool wall = s.scene().groups[p.data<Field::group>()[i]].kind == GroupKind::wall;
      p.data<Field::pressure>()[i] = wall ? 1e9 : field(x, y);  // walls are not asked
      p.data<Field::velocity>()[2 * i] = 0.01 * field(x, y);
    }
    EXPECT_NEAR(value_of(s, "inside_p"), field(2, 1.5), 1e-9) << kernel;
    EXPECT_NEAR(value_of(s, "inside_vx"), 0.01 * field(2, 1.5), 1e-11) << kernel;
    EXPECT_NEAR(value_of(s, "wall_p"), field(4, 1), 1e-8) << kernel;
    EXPECT_NEAR(value_of(s, "corner_p"), field(0, 0), 1e-8) << kernel;
    EXPECT_NEAR(value_of(s, "inside_cover"), 1, 0.04) << kernel;
    EXPECT_NEAR(value_of(s, "wall_cover"), 0.5, 0.06) << kernel;
    EXPECT_NEAR(value_of(s, "corner_cover"), 0.25, 0.06) << kernel;
    EXPECT_TRUE(std::isnan(value_of(s, "dry_p"))) << kernel;
    EXPECT_EQ(value_of(s, "dry_cover"), 0) << kernel;
  }
}

TEST(Gauges, find_the_surface) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  const std::string level = "[[monitor]]\nkind = \"level\"\nat = ";
  Simulation s(
      comm, parse_scene(tank("h_over_dx = 1.2",
                             level + "[2, 0.5]\nname = \"in\"\n" + level + "[2, 3.5]\nname = \"above\"\n" +
                                 level + "[4, 0.5]\nname = \"wall\"\n" + level +
                                 "[0, 0]\nname = \"corner\"\n" + level + "[-0.5, 0.5]\nname = \"behind\"\n"),
                        "tank", {}));
  EXPECT_NEAR(value_of(s, "wall_h"), 2.5, 0.03);
  EXPECT_NEAR(value_of(s, "corner_h"), 3, 0.03);
  EXPECT_TRUE(std::isnan(value_of(s, "behind_h")));
  // A slot of one particle, of whose kernels most are walls.
  Simulation slot(
      comm, parse_scene(tank("h_over_dx = 1.5", level + "[2.05, 0.5]\nname = \"in\"\n"), "tank",
                        {"start.region.1.lower=[2, 0]", "start.region.1.upper=[2.1, 5]",
                         "start.region.2.lower=[2, 0]", "start.region.2.upper=[2.1, 3]", "start.jitter=0"}));
  EXPECT_NEAR(value_of(slot, "in_h"), 2.5, 0.05);
  EXPECT_NEAR(value_of(s, "in_h"), 2.5, 0.02);
  EXPECT_EQ(value_of(s, "above_h"), 0);
}

/// A box of gas, periodic, jittered.
const std::string box = R"(
dimension = 3
[domain]
lower = [0, 0, 0]
upper = [2, 2, 2]
periodic = [true, true, true]
[kernel]
h_over_dx = 1.2
[[group]]
name = "gas"
kind = "fluid"
density = 1
sound_speed = 10
[start]
spacing = 0.125
jitter = 0.1
[[start.region]]
group = "gas"
[time]
steps = 1
)";

TEST(Gauges, see_through_periods) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  Simulation s(comm,
               parse_scene(box + gauge("corner", "[0, 0, 2]") + gauge("middle", "[1, 1, 1]"), "box", {}));
  EXPECT_NEAR(value_of(s, "corner_cover"), 1, 0.04);
  EXPECT_NEAR(value_of(s, "middle_cover"), 1, 0.04);
  EXPECT_NEAR(value_of(s, "corner_rho"), 1, 0.01);
}

std::string flux(const std::string& name, const std::string& lower, const std::string& upper) {
  return "[[monitor]]\nname = \"" + name + "\"\nkind = \"flux\"\nlower = " + lower + "\nupper = " + upper +
         "\n";
}

TEST(Gauges, say_what_passes) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  Simulation s(comm, parse_scene(box + flux("middle", "[1.03, 0, 0]", "[1.03, 2, 2]") +
                                     flux("face", "[0, 2, 0]", "[2, 2, 2]") +
                                     flux("half", "[0.5, 0.5, 0]", "[0.5, 1, 2]") +
                                     flux("none", "[0, 0, 1]", "[2, 2, 1]"),
                                 "box", {"group.gas.density=3", "start.velocity=[0.5, -0.25, 0]"}));
  EXPECT_NEAR(value_of(s, "middle_mass_rate"), 3 * 0.5 * 4, 0.05);
  EXPECT_NEAR(value_of(s, "middle_volume_rate"), 0.5 * 4, 0.02);
  EXPECT_NEAR(value_of(s, "face_mass_rate"), -3 * 0.25 * 4, 0.03);
  EXPECT_NEAR(value_of(s, "half_mass_rate"), 3 * 0.5, 0.05);
  EXPECT_EQ(value_of(s, "none_mass_rate"), 0);
}

// Where it is deleted, too: fewer particles say it then, in the mean over two of their distances the same.
TEST(Gauges, say_what_passes_beside_openings) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  const std::string open = "domain.periodic=[false, true, true]";
  for (const auto& [along, opening, at] :
       {std::array{open, std::string("domain.leaves=\"delete\""), std::string("1.9")},
        {open, "outlet=[{lower=[1.9,0,0], upper=[2,2,2]}]", "1.8"},
        // The same across a period.
        {"domain.periodic=[true, true, true]", "outlet=[{lower=[0,0,0], upper=[0.1,2,2]}]", "1.9"}}) {
    Simulation s(
        comm, parse_scene(box + flux("inside", "[1.03, 0, 0]", "[1.03, 2, 2]") +
                              flux("beside", "[" + at + ", 0, 0]", "[" + at + ", 2, 2]"),
                          "box",
                          {along, opening, "start.velocity=[0.5, 0, 0]", "time.dt=0.004", "time.steps=125"}));
    double inside = 0, beside = 0;
    for (int k = 0; k < 125; ++k) {
      s.step();
      inside += value_of(s, "inside_mass_rate");
      beside += value_of(s, "beside_mass_rate");
    }
    EXPECT_NEAR(beside / inside, 1, 0.04) << opening;
  }
}

// The tank without its right half, which fills: what has passed is what has come, but for what is in the slab.
TEST(Gauges, add_up_what_passes_to_what_came) {
  const decomp::Comm comm(MPI_COMM_SELF);
  Simulation s(comm, parse_scene(tank("h_over_dx = 1.2", flux("gate", "[2, 0]", "[2, 5]")), "tank",
                                 {"start.region.2.upper=[1.5, 3]", "start.jitter=0", "time.steps=700"}));
  const auto beyond = [&] {  // sum m Theta, Theta' = w of output/flux.hpp
    const Particles& p = s.particles();
    const double reach = 0.24;
    double sum = 0;
    for (std::size_t i = 0; i < p.owned(); ++i) {
      if (s.scene().groups[p.data<Field::group>()[i]].kind != GroupKind::fluid) continue;
      const double r = (s.scale().metres(p.data<Field::position>()[2 * i]) - 2) / reach;
      const double share = r > 1 ? 1 : r < -1 ? 0 : 0.5 + 15.0 / 16 * (r - r * r * r * (2.0 / 3 - r * r / 5));
      sum += p.data<Field::mass>()[i] * share;
    }
    return sum;
  };
  double passed = 0, before = value_of(s, "gate_mass_rate"), time = 0;
  for (int k = 0; k < 700; ++k) {
    s.step();
    const double now = value_of(s, "gate_mass_rate");
    passed += 0.5 * (before + now) * (s.global().time - time);
    before = now;
    time = s.global().time;
  }
  EXPECT_GT(beyond(), 500);
  EXPECT_NEAR(passed / beyond(), 1, 2e-3);
}

TEST(Gauges, have_the_same_bits_on_any_ranks) {
  const std::string text = tank("h_over_dx = 1.2", gauge("line", "[0, 0]", "to = [4, 3]\npoints = 5\n") +
                                                       "[[monitor]]\nkind = \"level\"\nat = [1, 0]\n" +
                                                       flux("gate", "[1, 2]", "[3, 2]"));
  const decomp::Comm world(MPI_COMM_WORLD), alone(MPI_COMM_SELF);
  Simulation shared(world, parse_scene(text, "tank", {})), own(alone, parse_scene(text, "tank", {}));
  for (int k = 0; k < 20; ++k) {
    shared.step();
    own.step();
  }
  const Monitors of_shared(shared), of_own(own);
  EXPECT_EQ(of_shared.names().size(), 5 * 5 + 3u);
  EXPECT_EQ(of_shared.names().front(), "line_1_vx");
  EXPECT_EQ(of_shared.values(shared), of_own.values(own));
}

}  // namespace
}  // namespace sph
