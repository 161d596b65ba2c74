// Grains in a fluid against the flows that are known: one grain (Stokes; Hasimoto 1959 for its images; any Re), beds
// (the drag law they are given), a suspension that settles (Richardson & Zaki 1954), a grain as heavy as the fluid.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "pinned.hpp"
#include "sph/laws/drag/di_felice.hpp"
#include "sph/laws/drag/gidaspow.hpp"
#include "tank.hpp"

namespace {

using namespace sph;
using namespace tank;

constexpr double length = 15;  // of a periodic box, in spacings of 1 m

/// Water that is driven along x past fixed grains.
std::string flow(const std::string& law, double diameter, const std::string& grains, double viscosity,
                 double sound, double drive, double speed) {
  return fmt::format(R"(
[domain]
lower = [0, 0, 0]
upper = [{0}, {0}, {0}]
periodic = [true, true, true]
gravity = [{1}, 0, 0]
[kernel]
h_over_dx = 1.2
[contact]
law = "linear"
[drag]
law = "{2}"
[[group]]
name = "water"
kind = "fluid"
density = 1000
sound_speed = {3}
viscosity = {4}
[[group]]
name = "grains"
kind = "grain"
density = 2500
diameter = {5}
fixed = true
normal_stiffness = 1e5
restitution = 0.5
[start]
spacing = 1
velocity = [{6}, 0, 0]
[[start.region]]
group = "water"
[[start.grains]]
group = "grains"
{7}
[time]
steps = 1
)",
                     length, drive, law, sound, viscosity, diameter, speed, grains);
}

double mean_speed(const Simulation& s) {
  const Particles& p = s.particles(0);
  double momentum = 0, mass = 0;
  for (std::size_t i = 0; i < p.owned(); ++i) {
    momentum += p.data<Field::mass>()[i] * p.data<Field::velocity>()[i * 3];
    mass += p.data<Field::mass>()[i];
  }
  return momentum / mass;
}

/// Of the grains on the fluid.
double force_on_grains(const Simulation& s) {
  const Particles& p = s.particles(1);
  double force = 0;
  for (std::size_t i = 0; i < p.owned(); ++i) force += p.data<Field::fluid_force>()[i * 3];
  return force;
}

/// Drag on one grain over that on it alone in all space, at the mean speed, less that of its periodic images.
double drag_of_one(double diameter, const Double3& place, std::vector<std::string> options = {}) {
  constexpr double eta = 1000, sound = 20, speed = 0.01;
  const double stokes = 3 * std::numbers::pi * eta * diameter;
  const std::string at =
      fmt::format("lower = [{}, {}, {}]\nupper = [{}, {}, {}]\nspacing = 1", place[0] - 0.5, place[1] - 0.5,
                  place[2] - 0.5, place[0] + 0.5, place[1] + 0.5, place[2] + 0.5);
  const double drive = stokes * speed / (1000 * length * length * length);
  Simulation s(self(), parse_scene(flow("stokes", diameter, at, eta, sound, drive, speed), "one", options));
  // The disturbance has spread over the box after (L / 2 pi)^2 / nu.
  while (s.global().time < 24) s.step();
  // A point force in a periodic box, Hasimoto (1959).
  const double images = 1 - 2.837297 * 0.5 * diameter / length;
  return force_on_grains(s) / (stokes * mean_speed(s)) * images;
}

TEST(Sediment, OneGrainIsDraggedAsStokesHasIt) {
  const Double3 here{7.6, 7.7, 7.9}, on_a_point{7.5, 7.5, 7.5};
  EXPECT_NEAR(PINNED(drag_of_one(0.6, here)), 1, 0.01);
  EXPECT_NEAR(PINNED(drag_of_one(0.6, on_a_point)), 1, 0.01);
  EXPECT_NEAR(PINNED(drag_of_one(0.4, here)), 1, 0.01);
  EXPECT_NEAR(PINNED(drag_of_one(0.2, here)), 1, 0.01);
  // What the correction is worth.
  EXPECT_LT(PINNED(drag_of_one(0.6, here, {"drag.own_disturbance=false"})), 0.85);
}

// A grain alone has none around it that screen what it does itself, however much of its kernel it is.
TEST(Sediment, OneGrainIsDraggedAsStokesHasItWithWendlandKernels) {
  const Double3 here{7.6, 7.7, 7.9};
  for (const char* shape : {"kernel.shape=wendland_c2", "kernel.shape=wendland_c4"})
    EXPECT_NEAR(PINNED(drag_of_one(0.8, here, {shape, "kernel.h_over_dx=1.6"})), 1, 0.01) << shape;
}

/// Drag on one grain over that of Di Felice's law, in a flow that meets it for the first time: its wake has not yet
/// come round through the period.
double drag_at(double reynolds, double diameter) {
  constexpr double speed = 0.01;
  const double eta = 1000 * speed * diameter / reynolds;
  const double law = DiFeliceDrag::resistance({1, speed, 1000, eta, diameter}) * speed;
  const std::string at = "lower = [7.1, 7.2, 7.4]\nupper = [8.1, 8.2, 8.4]\nspacing = 1";
  Simulation s(self(), parse_scene(flow("di_felice", diameter, at, eta, 20 * speed,
                                        law / (1000 * length * length * length), speed),
                                   "one", {}));
  double force = 0, mean = 0;
  int n = 0;
  while (s.global().time < 0.6 * length / speed) {
    s.step();
    if (s.global().time < 0.3 * length / speed) continue;
    force += force_on_grains(s);
    mean += mean_speed(s);
    ++n;
  }
  mean /= n;
  return force / n / (DiFeliceDrag::resistance({1, mean, 1000, eta, diameter}) * mean);
}

TEST(Sediment, OneGrainIsDraggedByItsLawAtAnyReynoldsNumber) {
  for (const double reynolds : {1.0, 10.0, 100.0})
    for (const double diameter : {0.6, 0.3})
      EXPECT_NEAR(PINNED(drag_at(reynolds, diameter)), 1, 0.02) << reynolds;
}

/// Force on the grains of a bed over that of the law at the mean speed. A lattice has none of the fluctuations by which
/// random grains screen each other: what one does to itself is not taken out.
template <class Law>
double drag_of_bed(double diameter, double apart, double reynolds) {
  const double e = 1 - std::numbers::pi / 6 * std::pow(diameter / apart, 3), speed = 0.01;
  const double eta = 1000 * e * speed * diameter / reynolds;
  const std::string all =
      fmt::format("lower = [0, 0, 0]\nupper = [{0}, {0}, {0}]\nspacing = {1}", length, apart);
  // The weight of the fluid between the grains is what holds them.
  const double drive =
      Law::resistance({e, speed, 1000, eta, diameter}) * speed / (apart * apart * apart * 1000 * e);
  Simulation s(self(), parse_scene(flow(std::string(Law::word), diameter, all, eta, 20 * speed, drive, speed),
                                   "bed", {"drag.own_disturbance=false"}));
  for (int k = 0; k < 200; ++k) s.step();
  const double mean = mean_speed(s), grains = static_cast<double>(s.particles(1).owned());
  EXPECT_NEAR(PINNED(mean), speed, 0.03 * speed);
  return force_on_grains(s) / grains / (Law::resistance({e, mean, 1000, eta, diameter}) * mean);
}

TEST(Sediment, BedsHoldTheFluidAsTheirLawHasIt) {
  EXPECT_NEAR(PINNED((drag_of_bed<GidaspowDrag>(0.7, 0.75, 0.01))), 1, 0.01);
  EXPECT_NEAR(PINNED((drag_of_bed<GidaspowDrag>(0.7, 0.75, 50))), 1, 0.01);
  EXPECT_NEAR(PINNED((drag_of_bed<DiFeliceDrag>(0.7, 0.75, 5))), 1, 0.01);
}

/// Grains at random places, none in another: each alone in a fill of its own.
std::vector<GrainFill> random_grains(std::size_t number, double diameter, const Double3& extent) {
  std::vector<GrainFill> fills;
  std::vector<Double3> places;
  std::uint64_t state = 1;
  const auto random = [&] {  // Knuth's
    state = state * 6364136223846793005U + 1442695040888963407U;
    return static_cast<double>(state >> 11) * 0x1p-53;
  };
  while (places.size() < number) {
    const Double3 x{extent[0] * random(), extent[1] * random(),
                    diameter + (extent[2] - 2 * diameter) * random()};
    const bool free = std::ranges::none_of(places, [&](const Double3& y) {
      double d2 = 0;
      for (std::size_t a = 0; a < 3; ++a) {
        double d = std::abs(x[a] - y[a]);
        if (a < 2) d = std::min(d, extent[a] - d);
        d2 += d * d;
      }
      return d2 < diameter * diameter;
    });
    if (!free) continue;
    places.push_back(x);
    GrainFill fill{2, x, x, 1};
    for (std::size_t a = 0; a < 3; ++a) fill.lower[a] -= 0.5, fill.upper[a] += 0.5;
    fills.push_back(fill);
  }
  return fills;
}

/// Under a lid.
Tank closed(double density, double viscosity, const std::string& fill) {
  return {.width = 13,
          .depth = 26,
          .viscosity = viscosity,
          .grain = fmt::format("density = {}\ndiameter = 0.5", density),
          .fill = fill,
          .stiffness = 1e5,
          .lid = true,
          .law = "di_felice"};
}

/// Of one grain in a creeping flow, as Di Felice's law has it.
double settling_alone(double density, double viscosity) {
  const double d = 0.5, volume = std::numbers::pi / 6 * d * d * d;
  return (density - 1000) * volume / DiFeliceDrag::resistance({1, 0, 1000, viscosity, d});
}

// Of the fluid there, which its depth compresses by 0.5 %, and which slows down from the shock of its start.
TEST(Sediment, AGrainAsHeavyAsTheFluidStaysInIt) {
  constexpr double viscosity = 100;
  Simulation s = filled(closed(1000 * (1 + 13.5 / (50 * 50)), viscosity,
                               "lower = [6, 6, 12]\nupper = [7, 7, 13]\nspacing = 1"));
  double fastest = 0;
  for (int k = 0; k < 200; ++k) {
    s.step();
    const double fluid = rising(s, 0, 10.5, 14.5);
    fastest = std::max(fastest, std::abs(s.particles(1).data<Field::velocity>()[2] - fluid));
  }
  EXPECT_LT(fastest, 1e-4 * settling_alone(2000, viscosity));
}

// Richardson & Zaki: v = v_0 e^n relative to the flow of both together, n = 4.65 in creeping flow; Di Felice's law
// has n = 4.7. A periodic box of width L slows random grains by 2.837 a / L times the share of their disturbances
// that others leave (Ladd 1990; Mo & Sangani 1994), that of hard spheres of Carnahan & Starling.
TEST(Sediment, SuspensionsSettleAsRichardsonAndZaki) {
  constexpr double viscosity = 9000, width = 13;
  for (const std::size_t number : {1500U, 6000U}) {
    Scene scene = scene_of(closed(2000, viscosity, "lower = [0, 0, 0]\nupper = [1, 1, 1]\nspacing = 1"));
    scene.start.fills = random_grains(number, 0.5, {width, width, 26});
    const double solid = static_cast<double>(number) * std::numbers::pi / 6 * 0.125 / (width * width * 25.5);
    Simulation s(self(), scene);
    double sum = 0;
    int n = 0;
    while (s.global().time < 1.5) {
      s.step();
      if (s.global().time < 0.5) continue;
      sum += (1 - solid) * (rising(s, 0, 8, 18) - rising(s, 1, 8, 18));
      ++n;
    }
    const double left =
        std::pow(1 - solid, 4) / (std::pow(1 + 2 * solid, 2) + solid * solid * solid * (solid - 4));
    const double box = 1 - 2.837 * 0.25 / width * left;
    const double v = sum / n / (settling_alone(2000, viscosity) * std::pow(1 - solid, 4.65) * box);
    EXPECT_NEAR(PINNED(v), 1, 0.05) << number;
  }
}

}  // namespace
