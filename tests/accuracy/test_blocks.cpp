// Total-Lagrangian blocks where lists, rows or the time step could deceive.
#include <gtest/gtest.h>

#include "accuracy/bodies.hpp"
#include "accuracy/pinned.hpp"

namespace {

using measure::Bodies, measure::Sample, measure::samples;

constexpr const char* block_scene = R"(
dimension = 2
[domain]
lower = [-20, -20]
upper = [70, 40]
[kernel]
h_over_dx = 1.1
[[group]]
name = "rock"
kind = "solid"
lagrangian = "total"
density = 1000
bulk_modulus = 1e7
poisson_ratio = 0.25
[start]
file = "given by the test"
[time]
steps = 1
)";

// Reference positions in single precision are modulo 8 to 16 supports: 32 m here. Two pieces of one group
// that far apart, which meet, touch nothing and must not be taken for neighbours of old.
TEST(Solids, PiecesThatMeetWereNotBonded) {
  const decomp::Comm comm(MPI_COMM_SELF);
  for (const char* precision : {"mixed", "double"}) {
    Bodies pieces(1000);
    for (int side : {0, 1})
      for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j)
          pieces.add(32 * side + 1.2 * (i + 0.5), 1.2 * (j + 0.5), side == 0 ? 8.05 : -8.05, 0);
    sph::Simulation s = pieces.start(comm, block_scene, 1.2, {"precision=" + std::string(precision)});
    for (int step = 0; step < 330; ++step) s.step();
    for (const Sample& q : samples(s)) EXPECT_NEAR(std::abs(q.v[0]), 8.05, 1e-3);
  }
}

// Springs and dashpots together must stay below the limit of the time step.
TEST(Solids, ViscousBlockComesToRest) {
  const decomp::Comm comm(MPI_COMM_SELF);
  Bodies block(1000);
  unsigned seed = 1;
  const auto speed = [&seed] { return 1e-3 * ((seed = seed * 1664525 + 1013904223) / 2147483648.0 - 1); };
  for (int i = 0; i < 14; ++i)
    for (int j = 0; j < 14; ++j) {
      const double vx = speed();
      block.add(i + 0.5, j + 0.5, vx, speed());
    }
  const auto kinetic = [](const sph::Simulation& s) {
    double sum = 0;
    for (const Sample& q : samples(s)) sum += 0.5 * q.mass * (q.v[0] * q.v[0] + q.v[1] * q.v[1]);
    return sum;
  };
  for (const char* viscosity : {"10000", "17000", "30000"}) {
    sph::Simulation s = block.start(comm, block_scene, 1,
                                    {"terms.hourglass=1", "group.rock.viscosity=" + std::string(viscosity)});
    const double before = kinetic(s);
    for (int step = 0; step < 200; ++step) s.step();
    EXPECT_LE(PINNED(kinetic(s)), 0.1 * before) << viscosity;
  }
}

}  // namespace
