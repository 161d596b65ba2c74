// Grains in a tank of fluid with walls and a surface: beds that stay at rest, melts whose viscosity is implicit, grains
// that float, grains lighter than the fluid.
#include <gtest/gtest.h>

#include "pinned.hpp"
#include "sph/models/drag_force.hpp"
#include "sph/output/monitors.hpp"
#include "tank.hpp"

namespace {

using namespace sph;
using namespace tank;

const std::string bed = "density = 2500\ndiameter = 0.49\nfixed = true";

// Porosity, reaction and the pressure of walls that do not belong together feed a flow through the bed for ever.
TEST(Sediment, ABedOnAWallStaysAtRest) {
  const Tank tank{.width = 11,
                  .depth = 10,
                  .viscosity = 50,
                  .grain = bed,
                  .fill = "lower = [0, 0, 0]\nupper = [11, 11, 5]\nspacing = 0.5",
                  .h_over_dx = 1,
                  .jitter = 0.05};
  Simulation s = filled(tank);
  go_on(s, 1);
  const double early = kinetic_energy(s);
  go_on(s, 4);
  EXPECT_LT(PINNED(kinetic_energy(s) / early), 1);
}

// Density diffusion knows what the pressure of a fluid that grains take up room in is at rest: with the weight of the
// fluid alone it sinks.
TEST(Sediment, ABedInMidWaterDoesNotMakeItSink) {
  const Tank tank{.width = 11,
                  .depth = 10,
                  .viscosity = 50,
                  .grain = bed,
                  .fill = "lower = [0, 0, 3]\nupper = [11, 11, 7]\nspacing = 0.5",
                  .h_over_dx = 1};
  Simulation s = filled(tank);
  go_on(s, 2);
  const double before = mean_height(s, 0);
  go_on(s, 6);
  EXPECT_NEAR(mean_height(s, 0), before, 2e-4);
}

// Implicit viscosity must spread what grains do to the fluid, whatever the time step: here nu dt / h^2 = 1.3, 0.16.
TEST(Sediment, GrainsSettleAlikeWithImplicitViscosity) {
  const Tank tank{.width = 13,
                  .depth = 12,
                  .viscosity = 1e5,
                  .grain = "density = 10000\ndiameter = 0.6",
                  .fill = "lower = [6.1, 6.2, 5.4]\nupper = [7.1, 7.2, 6.4]\nspacing = 1",
                  .more = "[terms]\nimplicit_viscosity = true\nviscosity_tolerance = 1e-7"};
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
  const Tank tank{.width = 11,
                  .depth = 9,
                  .viscosity = 20,
                  .grain = "density = 500\ndiameter = 0.5",
                  .fill = "lower = [5, 5, 7.5]\nupper = [6, 6, 8.5]\nspacing = 1",
                  .h_over_dx = 1};
  Simulation s = filled(tank, {"contact.largest_overlap=0.5"});
  go_on(s, 12);
  EXPECT_NEAR(PINNED(mean_height(s, 1)), 9, 0.1);
}

// Where grains are light the pressure moves them, too, and sound is faster: sqrt(1 + phi rho / (e rho_s)) = 6.6 times.
TEST(Sediment, LightGrainsMakeStepsShorter) {
  const Tank tank{.width = 11,
                  .depth = 8,
                  .viscosity = 10,
                  .grain = "density = 10\ndiameter = 0.5",
                  .fill = "lower = [0, 0, 2]\nupper = [11, 11, 6]\nspacing = 0.6",
                  .h_over_dx = 1,
                  .jitter = 0.05};
  Simulation s = filled(tank, {"group.grains.normal_stiffness=2"});
  for (int k = 0; k < 40; ++k) s.step();
  EXPECT_LT(s.global().dt * 50, 0.2);
  // They rise, which gives no more than the weight of the fluid in their place.
  const double buoyant = 990 * volume_of(0.25) * static_cast<double>(s.particles(1).owned());
  EXPECT_LT(kinetic_energy(s), buoyant * 4);
}

}  // namespace
