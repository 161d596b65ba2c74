// Walls hold what is thrown at them: a column of water 1 m square breaks in a tank 4 m long, strikes the far
// wall and runs up it. Torn particles keep their density, so that no pressure stops them (models/walls.cpp).
#include <gtest/gtest.h>

#include "accuracy/measure.hpp"
#include "accuracy/pinned.hpp"

namespace {

struct Flight {
  int inside = 0;  ///< particles behind a face, at most at any time
  double deepest = 1, highest = 0, energy = 0;
};

/// A column of this spacing to 1.5 s; the walls are `layers` thick.
Flight dam(double dx, int layers, std::vector<std::string> overrides) {
  const double thick = layers * dx;
  const auto text = [](const char* key, double x, double y) {
    return std::string(key) + "=[" + std::to_string(x) + ", " + std::to_string(y) + "]";
  };
  overrides.insert(overrides.end(),
                   {text("domain.lower", -thick - 1, -thick - 1), text("domain.upper", 5 + thick, 7),
                    "group.water.sound_speed=40", "start.spacing=" + std::to_string(dx),
                    text("start.lower", -thick, -thick), text("start.upper", 4 + thick, 5),
                    "start.region.1.upper=[4, 5]", "start.region.2.upper=[1, 1]", "time.cfl="});
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s(comm, sph::read_scene(PEPERITE_ACCURACY_DIR "/dam_break.toml", overrides));
  const auto energy = [&] {
    double sum = 0, mass = 0;
    for (const measure::Sample& q : measure::samples(s)) {
      if (measure::is_wall(s, q)) continue;
      sum += q.mass * (0.5 * (q.v[0] * q.v[0] + q.v[1] * q.v[1]) + 9.81 * q.x[1]);
      mass += q.mass;
    }
    return sum / mass;
  };
  const double first = energy();
  Flight out;
  measure::run_until(s, 1.5, [&] {
    if (s.global().step % 20 != 0) return;
    int inside = 0;
    for (const measure::Sample& q : measure::samples(s)) {
      if (measure::is_wall(s, q)) continue;
      const double before = std::min({q.x[0], q.x[1], 4 - q.x[0]});
      if (before < 0) ++inside;
      out.deepest = std::min(out.deepest, before / dx);
      out.highest = std::max(out.highest, q.x[1]);
    }
    out.inside = std::max(out.inside, inside);
    out.energy = std::max(out.energy, energy() / first);
  });
  std::printf("dam break: at most %d behind a face, deepest %.2f dx, highest %.2f m, energy %.4f\n",
              out.inside, -out.deepest, out.highest, out.energy);
  return out;
}

TEST(Walls, HoldTornFluid) {
  const Flight water = dam(0.02, 4, {"group.water.viscosity=0"});
  EXPECT_GT(water.highest, 1.2) << "nothing ran up the wall";
  EXPECT_LE(water.inside, 2);
  EXPECT_GE(PINNED(water.deepest), -0.5);
  EXPECT_LE(PINNED(water.energy), 1.003) << "walls gave energy";
}

// They stop what comes at any time step, by any kernel, beside a solver.
TEST(Walls, HoldWithWideKernelsAndImplicitViscosity) {
  for (const std::vector<std::string>& how :
       {std::vector<std::string>{"group.water.viscosity=0", "kernel.h_over_dx=1.6"},
        {"group.water.viscosity=0", "kernel.h_over_dx=3"},
        {"group.water.viscosity=0.1", "terms.implicit_viscosity=true"}}) {
    const Flight water = dam(0.05, 9, how);
    EXPECT_GE(PINNED(water.deepest), -0.5) << how.back();
    EXPECT_LE(PINNED(water.energy), 1.003) << how.back();
  }
}

// Without pressure and gravity nothing moves a lattice, unless walls push what rests on them or in their
// corners.
TEST(Walls, LeaveALatticeAtRest) {
  const decomp::Comm comm(MPI_COMM_SELF);
  for (const char* kernel : {"quintic", "wendland_c2", "wendland_c4"})
    for (const char* wide : {"1", "1.2", "1.4", "1.5", "1.7", "2", "2.5", "4"}) {
      sph::Simulation s(comm, sph::read_scene(PEPERITE_ACCURACY_DIR "/hydrostatic.toml",
                                              {"domain.gravity=[0, 0]", "domain.lower=[-2, -2]",
                                               "domain.upper=[3, 3]", std::string("kernel.shape=") + kernel,
                                               std::string("kernel.h_over_dx=") + wide, "start.spacing=0.04",
                                               "start.lower=[-0.48, -0.48]", "start.upper=[1.48, 1.48]",
                                               "start.region.2.upper=[1, 1.48]", "start.pressure=zero"}));
      for (int k = 0; k < 3; ++k) s.step();
      EXPECT_EQ(s.global().max_speed, 0) << kernel << ", h = " << wide << " dx";
    }
}

}  // namespace
