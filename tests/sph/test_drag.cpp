// Grains in a fluid: drag laws against their published forms, the porosity of packings, momentum, and the same
// bits on any ranks, cuts and restarts. What a grain settles with: accuracy.Sediment.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "grain_fixture.hpp"
#include "models/stability.hpp"
#include "output/extra_columns.hpp"
#include "sph/core/error.hpp"
#include "sph/laws/drag/di_felice.hpp"
#include "sph/laws/drag/gidaspow.hpp"
#include "sph/laws/drag/stokes.hpp"
#include "state_fixture.hpp"

namespace sph {
namespace {

const decomp::Comm& world() {
  static const decomp::Comm comm(MPI_COMM_WORLD);
  return comm;
}
const decomp::Comm& self() {
  static const decomp::Comm comm(MPI_COMM_SELF);
  return comm;
}

/// At a Reynolds number, of a fluid and a grain like any other.
DragState state(double porosity, double reynolds) {
  const double density = 1200, viscosity = 0.3, diameter = 2e-3;
  return {porosity, reynolds * viscosity / (density * porosity * diameter), density, viscosity, diameter};
}
double alone(const DragState& s) { return 3 * std::numbers::pi * s.viscosity * s.diameter; }

TEST(DragLaws, StokesIsThatOfASphereAlone) {
  EXPECT_DOUBLE_EQ(StokesDrag::resistance(state(0.5, 3)), alone(state(0.5, 3)));
}

// C Re / 24 of Wen & Yu is 1 + 0.15 Re^0.687; at Re = 0.01, 1, 100 the standard drag curve has 1.00, 1.15, 4.5.
TEST(DragLaws, GidaspowIsWenAndYuWhereGrainsAreFew) {
  for (const auto& [re, factor] : {std::pair{0.01, 1.0063}, {1.0, 1.15}, {100.0, 4.549}})
    EXPECT_NEAR(GidaspowDrag::resistance(state(1, re)) / alone(state(1, re)), factor, 1e-3 * factor) << re;
  const DragState s = state(0.9, 1e4);  // C = 0.44
  EXPECT_NEAR(GidaspowDrag::resistance(s) * s.speed,
              0.44 * std::numbers::pi / 8 * s.density * s.diameter * s.diameter * 0.9 * 0.9 * s.speed *
                  s.speed * std::pow(0.9, -2.65) / 0.9,
              1e-12 * alone(s) * s.speed * 1e4);
}

// The gradient of the pressure through a bed, 150 (1 - e)^2 eta U / (e^3 d^2) + 1.75 (1 - e) rho U^2 / (e^3 d) with
// the velocity U = e u through the bed; shared by fluid and grains, the drag on them holds its share e of it.
TEST(DragLaws, GidaspowIsErgunInBeds) {
  for (const double e : {0.35, 0.45, 0.6})
    for (const double re : {0.01, 10.0, 1000.0}) {
      const DragState s = state(e, re);
      const double d = s.diameter, u = e * s.speed;
      const double ergun = 150 * (1 - e) * (1 - e) * s.viscosity * u / (e * e * e * d * d) +
                           1.75 * (1 - e) * s.density * u * u / (e * e * e * d);
      const double grains = (1 - e) / (std::numbers::pi / 6 * d * d * d);
      EXPECT_NEAR(grains * GidaspowDrag::resistance(s) * s.speed, e * ergun, 1e-12 * ergun) << e << ' ' << re;
    }
}

// Coefficients as Di Felice has them, written with C Re and logarithms.
TEST(DragLaws, DiFelice) {
  for (const double e : {0.4, 0.7, 1.0})
    for (const double re : {1e-4, 0.3, 40.0, 3000.0}) {
      const DragState s = state(e, re);
      const double c = std::pow(0.63 + 4.8 / std::sqrt(re), 2);
      const double x = 3.7 - 0.65 * std::exp(-0.5 * std::pow(1.5 - std::log10(re), 2));
      const double through = e * s.speed;
      const double force = 0.5 * c * s.density * through * through * std::numbers::pi / 4 * s.diameter *
                           s.diameter * std::pow(e, -x);
      EXPECT_NEAR(DiFeliceDrag::resistance(s) * s.speed, force, 1e-12 * force) << e << ' ' << re;
    }
  DragState still = state(0.5, 1);
  still.speed = 0;  // in the limit of a creeping flow
  EXPECT_NEAR(DiFeliceDrag::resistance(still) / alone(still), 4.8 * 4.8 / 24 * std::pow(0.5, 1 - 3.7), 1e-12);
  still.viscosity = 0;
  EXPECT_EQ(DiFeliceDrag::resistance(still), 0);
}

/// Fluid in a periodic box, and grains on a lattice in some of it.
std::string box(const std::string& grains, const std::string& lattice, const std::string& more = "") {
  return R"(
[domain]
lower = [0, 0, 0]
upper = [0.013, 0.012, 0.012]
periodic = [true, true, true]
[kernel]
h_over_dx = 1.0
[contact]
law = "linear"
[drag]
law = "di_felice"
[[group]]
name = "water"
kind = "fluid"
density = 1000
sound_speed = 2
viscosity = 0.01
[[group]]
name = "sand"
kind = "grain"
density = 2500
normal_stiffness = 200
restitution = 0.5
friction = 0.4
)" + grains +
         R"(
[start]
spacing = 0.001
[[start.region]]
group = "water"
[[start.grains]]
group = "sand"
)" + lattice +
         "[time]\nsteps = 1\n" + more;
}

std::vector<double> of_fluid(const Simulation& s, const double* values) {
  return {values, values + s.particles(0).owned()};
}

// A cubic packing of grains, h 2.5 of their diameters, fills pi/6 0.8^3 = 0.268 of the volume wherever one looks.
TEST(Drag, PorosityOfAPacking) {
  const Scene scene = parse_scene(box("diameter = 0.0004\nfixed = true\n",
                                      "lower = [0, 0, 0]\nupper = [0.013, 0.012, 0.012]\nspacing = 0.0005\n"),
                                  "packing", {});
  Simulation s(world(), scene);
  const double solid = std::numbers::pi / 6 * std::pow(0.4 / 0.5, 3);
  for (const double e : of_fluid(s, s.particles(0).data<Field::porosity>()))
    EXPECT_NEAR(1 - e, solid, 0.002 * solid);
  // What the fluid fills is left of its mass, and its pressure is that of its own density.
  for (const double p : of_fluid(s, s.particles(0).data<Field::pressure>())) EXPECT_NEAR(p, 0, 1e-9);
  for (const double rho : of_fluid(s, s.particles(0).data<Field::density>()))
    EXPECT_NEAR(rho, 1000 * (1 - solid), 2);
}

// Springs as soft as that let grains lie in each other until nothing is left for the fluid.
TEST(Drag, NoFluidIsLeftBetweenGrainsThatLieInEachOther) {
  const Scene scene = parse_scene(box("diameter = 0.0004\n",
                                      "lower = [0.003, 0.003, 0.003]\nupper = [0.009, 0.009, 0.009]\n"
                                      "spacing = 0.0003001\n"),
                                  "crowd", {"contact.largest_overlap=0.5"});
  try {
    const Simulation s(world(), scene);
    FAIL() << "it began";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("of its volume for itself, less than 0.1"), std::string::npos)
        << error.what();
  }
}

const char* const moving_grains = "diameter = [0.0005, 0.0007]\n";
const char* const moving_lattice = "lower = [0, 0, 0.002]\nupper = [0.013, 0.012, 0.009]\nspacing = 0.0008\n";

// Grains are thrown into the fluid: what they lose it gets, but for the rounding of velocities.
TEST(Drag, MomentumIsConserved) {
  Scene scene = parse_scene(box(moving_grains, moving_lattice), "momentum",
                            {"start.jitter=0.2", "group.water.viscosity=0.1"});
  Simulation s(self(), scene);
  double* v = const_cast<Particles&>(s.particles(1)).data<Field::velocity>();
  for (std::size_t i = 0; i < s.particles(1).owned(); ++i) v[i * 3] = i % 3 == 0 ? 0.2 : -0.05;
  const auto momentum = [&](std::size_t set, std::size_t axis) {
    double sum = 0;
    const Particles& p = s.particles(set);
    for (std::size_t i = 0; i < p.owned(); ++i)
      sum += p.data<Field::mass>()[i] * p.data<Field::velocity>()[i * 3 + axis];
    return sum;
  };
  const double before = momentum(1, 0), of_water = momentum(0, 0);
  EXPECT_EQ(of_water, 0);
  for (int k = 0; k < 60; ++k) s.step();
  EXPECT_LT(std::abs(momentum(1, 0)), 0.7 * std::abs(before));
  EXPECT_NEAR(momentum(0, 0) + momentum(1, 0), before, 1e-13 * std::abs(before));
  EXPECT_NEAR(momentum(0, 1) + momentum(1, 1), 0, 1e-13 * std::abs(before));
}

/// After each step on one rank.
constexpr int steps = 40;
Scene mixture(const std::vector<std::string>& more = {}) {
  std::vector<std::string> options{"start.jitter=0.2", "start.velocity=[0.3, 0.1, 0]",
                                   "domain.gravity=[0, 0, -2]"};
  options.insert(options.end(), more.begin(), more.end());
  return parse_scene(box(moving_grains, moving_lattice), "mixture", options);
}
const std::vector<std::string>& expected() {
  static const std::vector<std::string> prints = [] {
    Simulation s(self(), mixture());
    std::vector<std::string> out;
    for (int k = 0; k < steps; ++k) s.step(), out.push_back(s.fingerprint());
    return out;
  }();
  return prints;
}

TEST(Drag, AnyRanksCutsAndSkinsGiveTheSameBits) {
  for (const char* skin : {"0.02", "0.25"}) {
    Simulation s(world(),
                 mixture({std::string("decomposition.skin=") + skin, "decomposition.balance=\"chaos\""}));
    for (std::size_t k = 0; k < steps; ++k) {
      s.step();
      ASSERT_EQ(s.fingerprint(), expected()[k]) << skin << ' ' << k;
    }
  }
}

// Output looks at all sets, contacts and averages at their own.
TEST(Drag, OutputIsThatOfOneRank) {
  const std::vector<std::string> more{"output.contacts=true", "output.average_space=true",
                                      "decomposition.balance=\"chaos\""};
  const std::string touching =
      "lower = [0.001, 0.001, 0.002]\nupper = [0.012, 0.011, 0.005]\nspacing = 0.00069\n";
  Scene scene = parse_scene(box("diameter = 0.0007\n", touching), "touching", more);
  for (const MonitorKind kind : {MonitorKind::energy, MonitorKind::contacts, MonitorKind::momentum}) {
    Monitor monitor;
    monitor.name = "m" + std::to_string(scene.output.monitors.size());
    monitor.kind = kind;
    scene.output.monitors.push_back(monitor);
  }
  Simulation alone(self(), scene), shared(world(), scene);
  const Monitors of_alone(alone), of_shared(shared);
  double contacts = 0;
  for (int k = 0; k < 30; ++k) {
    alone.step(), shared.step();
    const std::vector<double> values = of_alone.values(alone);
    ASSERT_EQ(values, of_shared.values(shared)) << k;
    contacts = std::max(contacts, values[4]);
    for (Simulation* s : {&alone, &shared})
      for (const ExtraColumn& column : extra_columns(*s))
        ASSERT_EQ(column.values.size(), s->particles().owned() * static_cast<std::size_t>(column.components));
    ASSERT_EQ(alone.fingerprint(), shared.fingerprint()) << k;
  }
  EXPECT_GT(contacts, 100);
}

TEST(Drag, RestartsDoToo) {
  const test::ScratchDirectory dir(world());
  const Scene scene = mixture({"decomposition.balance=\"chaos\""});
  auto s = std::make_unique<Simulation>(world(), scene);
  for (std::size_t k = 0; k < steps; ++k) {
    s->step();
    if (k % 16 != 3) continue;
    s = test::through_a_checkpoint(*s, dir.path());
    ASSERT_EQ(s->fingerprint(), expected()[k]) << k;
  }
  EXPECT_EQ(s->fingerprint(), expected().back());
}

// In a bed drag takes the fluid along within microseconds: the time step follows, and one that is given is refused.
TEST(Drag, LimitsTheTimeStep) {
  const std::string bed = box("diameter = 0.0004\nfixed = true\n",
                              "lower = [0, 0, 0]\nupper = [0.013, 0.012, 0.012]\nspacing = 0.0005\n");
  const std::vector<std::string> thick{"group.water.viscosity=1", "start.velocity=[0.01, 0, 0]"};
  Simulation free(world(), parse_scene(bed, "bed", thick));
  double before = 1;
  for (int k = 0; k < 10; ++k) {
    free.step();
    const double v = free.global().max_speed;
    EXPECT_LT(v, before) << k;
    before = v;
  }
  EXPECT_LT(free.global().dt, 1e-5);
  std::vector<std::string> fixed = thick;
  fixed.push_back("time.dt=2e-5");
  Simulation given(world(), parse_scene(bed, "bed", fixed));
  EXPECT_THROW(given.step(), GuardError);
}

// Where no grain moves the step of contacts is infinite, and a plane at rest goes 0 times that.
TEST(Drag, GluedGrainsRefuseNoPlane) {
  const std::string plane =
      "[[wall]]\nname = \"floor\"\nmaterial = \"sand\"\npoint = [0, 0, 0.001]\nnormal = [0, 0, 1]\n";
  const std::string lattice = "lower = [0, 0, 0.001]\nupper = [0.013, 0.012, 0.003]\nspacing = 0.0005\n";
  for (const std::string speed : {"0", "-1e4"}) {
    const std::vector<std::string> options{"domain.periodic=[true, true, false]",
                                           "wall.floor.velocity=[0, 0, " + speed + "]"};
    const auto check = [&](const std::string& grains) {
      check_time_step(parse_scene(box("diameter = 0.0004\n" + grains, lattice, plane), "glued", options));
    };
    EXPECT_NO_THROW(check("fixed = true\n")) << speed;
    if (speed == "0") continue;
    EXPECT_THROW(check(""), InputError);
  }
}

}  // namespace
}  // namespace sph
