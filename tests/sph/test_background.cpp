// Matter whose weight a background bears: at rest to the last bit where it is as heavy, as dense as all of the pressure
// makes it where it is of gas, and as under weaker gravity where it is not.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "sph/laws/eos/bubbly.hpp"
#include "sph/step/simulation.hpp"

namespace {

using sph::Field;
using sph::Simulation;

const decomp::Comm& world() {
  static const decomp::Comm comm(MPI_COMM_WORLD);
  return comm;
}

/// Two runs that are compared row by row must share rows alike, which measured cuts do not.
const decomp::Comm& alone() {
  static const decomp::Comm comm(MPI_COMM_SELF);
  return comm;
}

double all_max(const decomp::Comm& comm, double x) {
  comm.max(std::span(&x, 1));
  return x;
}

double largest(const Simulation& s, double (*value)(const sph::Particles&, std::size_t)) {
  double most = 0;
  for (std::size_t i = 0; i < s.particles().owned(); ++i)
    if (s.scene().groups[s.particles().data<Field::group>()[i]].kind != sph::GroupKind::wall)
      most = std::max(most, std::abs(value(s.particles(), i)));
  return all_max(s.comm(), most);
}
double speed(const sph::Particles& p, std::size_t i) {
  const double* v = p.data<Field::velocity>() + 2 * i;
  return std::hypot(v[0], v[1]);
}

/// A closed tank 10 wide and 20 high.
std::string tank(const std::string& domain, const std::string& groups, const std::string& more) {
  return "[domain]\nlower = [-3, -3]\nupper = [13, 23]\ngravity = [0, -9.8]\n" + domain +
         "[kernel]\nh_over_dx = 1.0\n" + groups +
         "[[group]]\nname = \"tank\"\nkind = \"wall\"\n[start]\nspacing = 1\njitter = 0.1\n[[start.region]]\n"
         "group = \"tank\"\n[[start.region]]\ngroup = \"melt\"\nshape = \"box\"\nlower = [0, 0]\nupper = "
         "[10, 20]\n" +
         more + "[time]\ncfl = 0.8\nsteps = 1\n";
}
std::string melt(const std::string& density, const std::string& kind = "fluid") {
  return "[[group]]\nname = \"melt\"\nkind = \"" + kind + "\"\ndensity = " + density +
         "\nsound_speed = 1\nviscosity = 1\n";
}

std::string stone(const std::string& density) {
  return "[[group]]\nname = \"stone\"\nkind = \"solid\"\nlagrangian = \"total\"\ndensity = " + density +
         "\nsound_speed = 1\npoisson_ratio = 0.25\n";
}
const std::string stone_place =
    "[[start.region]]\ngroup = \"stone\"\nshape = \"box\"\nlower = [3, 6]\nupper = [7, 11]\n";

TEST(Background, BearsBodiesExactly) {
  for (const char* density : {"2500", "2505"}) {
    Simulation s(world(), sph::parse_scene(
                              tank("background_density = 2500\n", melt("2500") + stone(density), stone_place),
                              "tank", {}));
    while (s.global().time < 20) s.step();
    double down = 0;
    for (std::size_t i = 0; i < s.particles().owned(); ++i)
      if (s.particles().data<Field::group>()[i] == 1)
        down = std::max(down, -s.particles().data<Field::velocity>()[2 * i + 1]);
    if (density == std::string("2500"))
      EXPECT_EQ(largest(s, speed), 0);
    else
      EXPECT_GT(all_max(s.comm(), down), 0.01);
  }
}

// sqrt(g H) is 14 m/s, and the sound as slow as 1 m/s. 100 transits of 20 m.
TEST(Background, BearsWhatIsAsHeavyExactly) {
  for (const char* precision : {"precision=\"double\"", "precision=\"mixed\""})
    for (const char* jitter : {"start.jitter=0.1", "start.jitter=0"}) {
      Simulation s(world(), sph::parse_scene(tank("background_density = 2500\n", melt("2500"), ""), "tank",
                                             {precision, jitter}));
      while (s.global().time < 2000) s.step();
      EXPECT_EQ(largest(s, speed), 0) << precision << jitter;
    }
  const std::string rock =
      "[[group]]\nname = \"rock\"\nkind = \"solid\"\ndensity = 2500\nsound_speed = 1\n"
      "poisson_ratio = 0.25\n";
  const std::string block =
      "[[start.region]]\ngroup = \"rock\"\nshape = \"box\"\nlower = [0, 0]\nupper = [10, 8]\n";
  Simulation s(world(), sph::parse_scene(tank("background_density = 2500\nsurface_pressure = 1e3\n",
                                              melt("2500") + rock, block),
                                         "tank", {}));
  for (int k = 0; k < 500; ++k) s.step();
  EXPECT_EQ(largest(s, speed), 0);
}

// Gravity along a period, where no hydrostatic pressure is possible: what the rock around it balances stays at rest
// at the pressure it starts with, from walls to walls; a lattice to the last bits of the arithmetic, a disordered start
// until its particles lie as the pressure likes.
TEST(Background, KeepsAUniformPressureAlongAPeriod) {
  const auto slot = [](const std::string& jitter) {
    const std::vector<std::string> along{"domain.periodic=[false, true]", "domain.lower=[-3, 0]",
                                         "domain.upper=[13, 20]",         "group.melt.sound_speed=10",
                                         "group.melt.viscosity=1000",     "start.pressure=uniform",
                                         "start.uniform_pressure=5 kPa",  jitter};
    return sph::parse_scene(tank("background_density = 2500\n", melt("2500"), ""), "slot", along);
  };
  const double stiffness = 2500 * 100, pressure = 5000;
  for (const auto& [jitter, fastest, off] :
       {std::tuple("start.jitter=0", 1e-9, 1e-9), std::tuple("start.jitter=0.05", 3e-3, 1e-3)}) {
    Simulation s(alone(), slot(jitter));
    const sph::Particles& p = s.particles();
    const auto mean = [&] {
      std::array<double, 2> sums{};
      for (std::size_t i = 0; i < p.owned(); ++i)
        if (s.scene().groups[p.data<Field::group>()[i]].kind != sph::GroupKind::wall) {
          sums[0] += 1;
          sums[1] += stiffness * (p.data<Field::density>()[i] / 2500 - 1);
        }
      return sums[1] / sums[0];
    };
    EXPECT_NEAR(mean(), pressure, 1e-9 * pressure) << jitter;
    while (s.global().time < 100) s.step();
    EXPECT_LT(largest(s, speed), fastest) << jitter;
    EXPECT_NEAR(mean(), pressure, off * pressure) << jitter;
  }
}

// The excess of two layers: as still as layers without a background are, at a sixth of their speed of sound.
TEST(Background, LeavesTheExcessToLayers) {
  const std::string groups = melt("2600") +
                             "[[group]]\nname = \"oil\"\nkind = \"fluid\"\ndensity = 2450\n"
                             "sound_speed = 20\nviscosity = 1\n";
  const std::string more =
      "[[start.region]]\ngroup = \"oil\"\nshape = \"box\"\nlower = [0, 10]\nupper = [10, 20]\n";
  Simulation s(world(),
               sph::parse_scene(tank("background_density = 2400\n", groups, more), "tank",
                                {"group.melt.sound_speed=20", "start.jitter=0", "start.pressure=hydrostatic",
                                 "start.layer=[{group=\"oil\", top=20}, {group=\"melt\", top=10}]"}));
  const sph::Particles& p = s.particles();
  const double light = 50 * 9.8, dense = 200 * 9.8;  // [Pa/m]
  for (std::size_t i = 0; i < p.owned(); ++i) {
    const sph::Group& g = s.scene().groups[p.data<Field::group>()[i]];
    if (g.kind == sph::GroupKind::wall) continue;
    const double y = s.scale().metres(p.data<Field::position>()[2 * i + 1]);
    const double pressure = g.eos.bulk_modulus * (p.data<Field::density>()[i] / g.density - 1);
    const double depth = 20 - y, excess = y > 10 ? light * depth : light * 10 + dense * (depth - 10);
    EXPECT_NEAR(pressure, excess, 0.02 * excess) << y;
  }
  for (int k = 0; k < 500; ++k) s.step();
  EXPECT_LT(largest(s, speed), 0.02);
}

// The same foam with and without: its density, gas and pressure are those of all that presses on it.
TEST(Background, GasFeelsAllOfThePressure) {
  const std::string foam =
      "[[group]]\nname = \"melt\"\nkind = \"fluid\"\neos = \"bubbly\"\ndensity = 2500\nsound_speed = 200\n"
      "gas_content = 2e-3\ngas_rt = 5e5\nsolubility_pressure = 1e9\nviscosity = 1000\npermeability = { "
      "coefficient = 1e-9 }\n";
  const std::vector<std::string> still{"start.pressure=hydrostatic", "start.surface_height=20",
                                       "start.jitter=0"};
  Simulation with(alone(), sph::parse_scene(tank("background_density = 2000\nbackground_surface = 20\n"
                                                 "surface_pressure = 1e6\n",
                                                 foam, ""),
                                            "tank", still));
  Simulation without(alone(), sph::parse_scene(tank("surface_pressure = 1e6\n", foam, ""), "tank", still));
  const auto compare = [&](double of_density, double of_pressure, double of_gas) {
    const sph::Particles &a = with.particles(), &b = without.particles();
    ASSERT_EQ(a.owned(), b.owned());
    for (std::size_t i = 0; i < a.owned(); ++i) {
      if (a.data<Field::group>()[i] != 0) continue;
      const double y = with.scale().metres(a.data<Field::position>()[2 * i + 1]);
      const double borne = 2000 * 9.8 * (20 - y);
      EXPECT_NEAR(a.data<Field::density>()[i], b.data<Field::density>()[i], of_density);
      EXPECT_NEAR(a.data<Field::pressure>()[i] + borne, b.data<Field::pressure>()[i], of_pressure);
      EXPECT_NEAR(a.data<Field::gas_content>()[i], b.data<Field::gas_content>()[i], of_gas);
      EXPECT_NEAR(a.data<Field::void_fraction>()[i], b.data<Field::void_fraction>()[i], of_density / 1000);
    }
  };
  with.step();
  without.step();
  compare(0.01, 10, 1e-9);
  for (int k = 0; k < 100; ++k) with.step(), without.step();
  compare(25, 12000, 1e-5);  // corners are not quiet
}

// One liquid: as under weaker gravity, in forces, heads and at walls.
TEST(Background, IsWeakerGravityToOneLiquid) {
  for (const char* walls : {"group.tank.slip=false", "group.tank.slip=true"}) {
    const std::vector<std::string> usual{walls, "group.melt.sound_speed=30", "start.velocity=[0.5, 0]"};
    std::vector<std::string> weaker = usual;
    weaker.push_back("domain.gravity=[0, -1.96]");
    Simulation with(alone(),
                    sph::parse_scene(tank("background_density = 2000\n", melt("2500"), ""), "tank", usual));
    Simulation without(alone(), sph::parse_scene(tank("", melt("2500"), ""), "tank", weaker));
    for (int k = 0; k < 200; ++k) with.step(), without.step();
    const sph::Particles &a = with.particles(), &b = without.particles();
    EXPECT_GT(largest(with, speed), 0.1);
    ASSERT_EQ(a.owned(), b.owned());
    for (std::size_t i = 0; i < a.owned(); ++i)
      for (std::size_t k = 2 * i; k < 2 * i + 2; ++k) {
        ASSERT_EQ(a.data<Field::id>()[i], b.data<Field::id>()[i]);
        EXPECT_NEAR(a.data<Field::velocity>()[k], b.data<Field::velocity>()[k], 1e-6);
      }
  }
}

// A light drop rises by 1.8 m in 4 s as the lattice gets finer: at 3 spacings in radius by 1.8 with a background, and
// without, under pressures of its own depth and with sound eight times as fast, by 1.1.
TEST(Background, DropsRise) {
  const std::string groups = melt("2500") +
                             "[[group]]\nname = \"oil\"\nkind = \"fluid\"\ndensity = 2000\n"
                             "sound_speed = 20\nviscosity = 3000\n";
  const std::string drop =
      "[[start.region]]\ngroup = \"oil\"\nshape = \"ball\"\ncentre = [5, 6]\nradius = 3\n";
  Simulation s(world(), sph::parse_scene(
                            tank("background_density = 2500\n", groups, drop), "tank",
                            {"group.melt.sound_speed=20", "group.melt.viscosity=3000", "start.jitter=0"}));
  while (s.global().time < 4) s.step();
  double sum = 0;
  std::int64_t n = 0;
  for (std::size_t i = 0; i < s.particles().owned(); ++i)
    if (s.particles().data<Field::group>()[i] == 1) {
      sum += s.scale().metres(s.particles().data<Field::position>()[2 * i + 1]);
      ++n;
    }
  const auto nanometres = static_cast<std::int64_t>(std::llround(sum * 1e9));
  const double height =
      static_cast<double>(world().sum(nanometres)) * 1e-9 / static_cast<double>(world().sum(n));
  EXPECT_NEAR(height - 6, 1.8, 0.1);
}

}  // namespace
