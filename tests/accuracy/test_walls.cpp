// Walls hold what is thrown at them: a column of water 1 m square breaks in a tank 4 m long, strikes the far
// wall and runs up it. Torn particles keep their density, so that no pressure stops them (Physics::hold_off).
#include <gtest/gtest.h>

#include "accuracy/measure.hpp"

namespace {

sph::Simulation dam(const decomp::Comm& comm) {
  return sph::Simulation(
      comm, sph::read_scene(PEPERITE_ACCURACY_DIR "/dam_break.toml",
                            {"domain.lower=[-0.2, -0.2]", "domain.upper=[4.2, 6]",
                             "group.water.sound_speed=40", "group.water.viscosity=0", "start.spacing=0.02",
                             "start.lower=[-0.08, -0.08]", "start.upper=[4.08, 5]",
                             "start.region.1.upper=[4, 5]", "start.region.2.upper=[1, 1]", "time.cfl="}));
}

TEST(Walls, HoldTornFluid) {
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s = dam(comm);
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
  int most = 0;
  double deepest = 1, highest = 0, largest = 0;
  measure::run_until(s, 1.5, [&] {
    if (s.global().step % 50 != 0) return;
    int inside = 0;
    for (const measure::Sample& q : measure::samples(s)) {
      if (measure::is_wall(s, q)) continue;
      const double before = std::min({q.x[0], q.x[1], 4 - q.x[0]});
      if (before < 0) ++inside;
      deepest = std::min(deepest, before);
      highest = std::max(highest, q.x[1]);
    }
    most = std::max(most, inside);
    largest = std::max(largest, energy() / first);
  });
  std::printf("dam break: at most %d of 2500 behind a face, deepest %.2f dx, highest %.2f m, energy %.4f\n",
              most, -deepest / 0.02, highest, largest);
  EXPECT_GT(highest, 1.2) << "nothing ran up the wall";
  EXPECT_LE(most, 2);
  EXPECT_LE(-deepest, 0.5 * 0.02);
  EXPECT_LE(largest, 1.003) << "walls gave energy";
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
                                               "start.region.2.upper=[1, 1.48]", "start.pressure="}));
      for (int k = 0; k < 3; ++k) s.step();
      EXPECT_EQ(s.global().max_speed, 0) << kernel << ", h = " << wide << " dx";
    }
}

}  // namespace
