// Grains in a tank of fluid with walls and a surface: beds that stay at rest, melts whose viscosity is implicit, grains
// that float, grains lighter than the fluid.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "measure.hpp"
#include "pinned.hpp"
#include "sph/models/drag_force.hpp"
#include "sph/output/monitors.hpp"

namespace {

using namespace sph;

const decomp::Comm& self() {
  static const decomp::Comm comm(MPI_COMM_SELF);
  return comm;
}

struct Tank {
  double width, depth, viscosity, jitter;
  std::string terms, grain, fill;
};

/// Spacings of 1 m, g = 1 m/s^2, c = 50 m/s, rho = 1000 kg/m^3.
Simulation filled(const Tank& tank, const std::vector<std::string>& options = {}) {
  return {self(), parse_scene(fmt::format(R"(
[domain]
lower = [0, 0, -4]
upper = [{0}, {0}, {1}]
periodic = [true, true, false]
gravity = [0, 0, -1]
[contact]
law = "linear"
[drag]
law = "stokes"
{3}
[[group]]
name = "water"
kind = "fluid"
density = 1000
sound_speed = 50
viscosity = {4}
[[group]]
name = "wall"
kind = "wall"
[[group]]
name = "grains"
kind = "grain"
normal_stiffness = 1e4
restitution = 0.5
{5}
[start]
spacing = 1
jitter = {7}
pressure = "hydrostatic"
surface_height = {2}
[[start.region]]
group = "wall"
[[start.region]]
group = "none"
shape = "box"
lower = [0, 0, 0]
upper = [{0}, {0}, {1}]
[[start.region]]
group = "water"
shape = "box"
lower = [0, 0, 0]
upper = [{0}, {0}, {2}]
[[start.grains]]
group = "grains"
{6}
[time]
steps = 1
)",
                                          tank.width, tank.depth + 4, tank.depth, tank.terms, tank.viscosity,
                                          tank.grain, tank.fill, tank.jitter),
                              "tank", options)};
}

double mean_height(const Simulation& s, std::size_t set) {
  const Particles& p = s.particles(set);
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < p.owned(); ++i) {
    const double z = s.scale().metres(p.data<Field::position>()[i * 3 + 2]);
    if (set == 0 && p.data<Field::group>()[i] != 0) continue;
    sum += z;
    count += 1;
  }
  return sum / count;
}

void go_on(Simulation& s, double until) {
  while (s.global().time < until) s.step();
}

const std::string bed = "density = 2500\ndiameter = 0.49\nfixed = true", fine = "[kernel]\nh_over_dx = 1";

// Porosity, reaction and the pressure of walls that do not belong together feed a flow through the bed for ever.
TEST(Sediment, ABedOnAWallStaysAtRest) {
  const Tank tank{11, 10, 50, 0.05, fine, bed, "lower = [0, 0, 0]\nupper = [11, 11, 5]\nspacing = 0.5"};
  Simulation s = filled(tank);
  go_on(s, 1);
  const double early = kinetic_energy(s);
  go_on(s, 4);
  EXPECT_LT(PINNED(kinetic_energy(s) / early), 1);
}

// Density diffusion knows what the pressure of a fluid that grains take up room in is at rest: with the weight of the
// fluid alone it sinks.
TEST(Sediment, ABedInMidWaterDoesNotMakeItSink) {
  const Tank tank{11, 10, 50, 0, fine, bed, "lower = [0, 0, 3]\nupper = [11, 11, 7]\nspacing = 0.5"};
  Simulation s = filled(tank);
  go_on(s, 2);
  const double before = mean_height(s, 0);
  go_on(s, 6);
  EXPECT_NEAR(mean_height(s, 0), before, 2e-4);
}

// Implicit viscosity must spread what grains do to the fluid, whatever the time step: here nu dt / h^2 = 1.3, 0.16.
TEST(Sediment, GrainsSettleAlikeWithImplicitViscosity) {
  const std::string terms =
      "[terms]\nimplicit_viscosity = true\nviscosity_tolerance = 1e-7\n[kernel]\nh_over_dx = 1.2";
  const Tank tank{13,
                  12,
                  1e5,
                  0,
                  terms,
                  "density = 10000\ndiameter = 0.6",
                  "lower = [6.1, 6.2, 5.4]\nupper = [7.1, 7.2, 6.4]\nspacing = 1"};
  const auto speed = [&](const std::string& cfl) {
    Simulation s = filled(tank, {"time.cfl=" + cfl});
    go_on(s, 1);
    return -s.particles(1).data<Field::velocity>()[2];
  };
  const double usual = speed("0.8"), short_steps = speed("0.1");
  EXPECT_NEAR(PINNED(usual / short_steps), 1, 0.02);
  // Of the same grain alone in all space: walls, surface and its images hold it back.
  const double alone = 9000 * 0.36 / (18 * 1e5);
  EXPECT_LT(PINNED(usual / alone), 1);
  EXPECT_GT(usual / alone, 0.9);
}

// Half as heavy as the fluid: half of it is below the surface.
TEST(Sediment, CorkFloatsHalfImmersed) {
  const Tank tank{11,
                  9,
                  20,
                  0,
                  fine,
                  "density = 500\ndiameter = 0.5",
                  "lower = [5, 5, 7.5]\nupper = [6, 6, 8.5]\nspacing = 1"};
  Simulation s = filled(tank, {"contact.largest_overlap=0.5"});
  go_on(s, 12);
  EXPECT_NEAR(PINNED(mean_height(s, 1)), 9, 0.1);
}

// Where grains are light the pressure moves them, too, and sound is faster: sqrt(1 + phi rho / (e rho_s)) = 6.6 times.
TEST(Sediment, LightGrainsMakeStepsShorter) {
  const Tank tank{11,
                  8,
                  10,
                  0.05,
                  fine,
                  "density = 10\ndiameter = 0.5",
                  "lower = [0, 0, 2]\nupper = [11, 11, 6]\nspacing = 0.6"};
  Simulation s = filled(tank, {"group.grains.normal_stiffness=2"});
  for (int k = 0; k < 40; ++k) s.step();
  EXPECT_LT(s.global().dt * 50, 0.2);
  // They rise, which gives no more than the weight of the fluid in their place.
  const double buoyant = 990 * volume_of(0.25) * static_cast<double>(s.particles(1).owned());
  EXPECT_LT(kinetic_energy(s), buoyant * 4);
}

}  // namespace
