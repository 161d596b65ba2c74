// Cuts follow the measured time of real passes: a rank that is slowed gives its particles away.
#include <gtest/gtest.h>

#include <string>

#include "sph/step/simulation.hpp"

namespace sph {
namespace {

/// Owned by the slowed rank 0 over the mean, after so many steps; and the state's fingerprint.
struct Outcome {
  double share;
  std::string fingerprint;
};

Outcome run(const std::string& balance, double slowness) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  Scene scene = read_scene(PEPERITE_ACCURACY_DIR "/taylor_green.toml", {});
  scene.decomposition.rebuild_every = 1;
  scene.decomposition.slowness = slowness;
  scene.decomposition.cuts = balance == "hybrid"    ? CutRule::hybrid
                             : balance == "literal" ? CutRule::literal
                             : balance == "fixed"   ? CutRule::fixed
                                                    : CutRule::quasi_newton;
  Simulation simulation(comm, scene);
  for (int k = 0; k < 150; ++k) simulation.step();
  const auto all = comm.all_gather(static_cast<std::int64_t>(simulation.particles().owned()));
  return {static_cast<double>(all[0]) * comm.size() / static_cast<double>(simulation.particle_count()),
          simulation.fingerprint()};
}

TEST(Balance, ASlowRankGivesItsParticlesAway) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  if (comm.size() == 1) GTEST_SKIP() << "needs ranks to balance";
  const Outcome fixed = run("fixed", 3);
  for (const char* balance : {"quasi_newton", "hybrid"}) {
    const Outcome balanced = run(balance, 3);
    EXPECT_LT(balanced.share, 0.8 * fixed.share) << balance;
    EXPECT_EQ(balanced.fingerprint, fixed.fingerprint) << balance;
  }
}

}  // namespace
}  // namespace sph
