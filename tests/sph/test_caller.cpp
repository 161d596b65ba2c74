// What a program does to a scene that it steps: accelerations act on the particles that they are given for, in each set, and a
// scene whose grains came so goes on from a checkpoint with the bits that it would have had.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "grain_fixture.hpp"
#include "sph/core/error.hpp"
#include "state_fixture.hpp"

namespace sph {
namespace {

const std::string box =
    "[domain]\nlower = [0, 0, 0]\nupper = [0.04, 0.02, 0.03]\nperiodic = [false, true, false]\n"
    "leaves = \"delete\"\n[contact]\nlaw = \"linear\"\ntangential_damping = 0.5\n"
    "[[group]]\nname = \"sand\"\nkind = \"grain\"\ndensity = 2500\ndiameter = [0.0015, 0.002]\n"
    "normal_stiffness = 500\nrestitution = 0.5\nfriction = 0.5\n"
    "[[wall]]\nname = \"floor\"\nmaterial = \"sand\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n"
    "[start]\nspacing = 0.002\njitter = 0.02\nlower = [0, 0, 0]\nupper = [0.04, 0.02, 0.008]\n"
    "[[start.region]]\ngroup = \"sand\"\n[time]\nsteps = 9\n";

class Caller : public testing::Test {
 protected:
  /// Of a row's place, velocity and time alone.
  static Accelerate swing(const Simulation& s) {
    return [&s](double time, std::span<double> accelerations) {
      const Particles& p = s.particles();
      ASSERT_EQ(accelerations.size(), 3 * p.owned());
      const std::int64_t* x = p.data<Field::position>();
      const double* v = p.data<Field::velocity>();
      for (std::size_t k = 0; k < accelerations.size(); ++k)
        accelerations[k] =
            -2000 * time - 100 * s.scale().metres(s.wrap()(static_cast<int>(k % 3), x[k])) - v[k];
    };
  }
  static void run(Simulation& s, int steps) {
    const Accelerate accelerate = swing(s);
    for (int k = 0; k < steps; ++k) s.step(0, accelerate);
  }
  static std::vector<GivenGrain> rain(double x) {
    std::vector<GivenGrain> out;
    for (int k = 0; k < 5; ++k) out.push_back({0, 0.0008, {x, 0.001 + 0.004 * k, 0.02}, {0.5, 0, -1}});
    return out;
  }

  const decomp::Comm world_{MPI_COMM_WORLD};
  const test::ScratchDirectory scratch_{world_};
};

TEST_F(Caller, GoesOnFromACheckpoint) {
  Simulation s(world_, parse_scene(box, "box", {}));
  run(s, 40);
  s.exchange_grains({}, rain(0.004));
  run(s, 40);
  const std::uint64_t first = s.global().throughput.id_stride;  // of those that came
  s.exchange_grains(std::array<std::uint64_t, 2>{first, first + 3}, {});
  const std::unique_ptr<Simulation> other = test::through_a_checkpoint(s, scratch_.path());
  for (Simulation* of : {&s, other.get()}) {
    run(*of, 40);
    of->exchange_grains({}, rain(0.012));
    run(*of, 40);
  }
  EXPECT_EQ(s.fingerprint(), other->fingerprint());
  EXPECT_EQ(s.global().throughput.passages.back().count, 10);
}

// What it gave is forgotten, and it is given zeros to add to.
TEST_F(Caller, GivesForOneStep) {
  Simulation s(world_, parse_scene(box, "box", {})), other(world_, parse_scene(box, "box", {}));
  for (Simulation* of : {&s, &other})
    of->step(0, [](double, std::span<double> a) { std::ranges::fill(a, 5.0); });
  s.step();
  other.step(0, [](double, std::span<double>) {});
  EXPECT_EQ(s.fingerprint(), other.fingerprint());
}

TEST_F(Caller, WhatDoesNotFitLeavesAllAsItWas) {
  Simulation s(world_, parse_scene(box, "box", {}));
  run(s, 40);
  const std::string before = s.fingerprint();
  std::vector<GivenGrain> same = rain(0.02);
  same.push_back(same.front());
  EXPECT_THROW(s.exchange_grains({}, same), InputError);
  EXPECT_THROW(s.exchange_grains(std::array<std::uint64_t, 1>{9999}, rain(0.02)), InputError);
  EXPECT_EQ(s.fingerprint(), before);
}

}  // namespace
}  // namespace sph
