// A state that is read is the state that was written, whatever stages find out before the next step: what has failed at
// the end of a step bears less than its stress, which is state, still says.
#include <gtest/gtest.h>

#include "sph/checkpoint/checkpoint.hpp"
#include "sph/step/simulation.hpp"
#include "state_fixture.hpp"

namespace sph {
namespace {

TEST(ReadStates, AreThoseThatWereWritten) {
  const decomp::Comm world(MPI_COMM_WORLD);
  const test::ScratchDirectory scratch(world);
  Simulation s(world, read_scene(PEPERITE_TEST_DIR "/scenes/tear2d.toml", {}));
  std::vector<std::string> groups;
  for (const Group& g : s.scene().groups) groups.push_back(g.name);
  std::int64_t failed = 0;
  for (int step = 1; step <= 40; ++step) {
    s.step();
    if (step % 4 != 2) continue;
    for (std::size_t i = 0; i < s.particles().owned(); ++i)
      failed += s.scene().groups[s.particles().data<Field::group>()[i]].kind == GroupKind::fluid ? 1 : 0;
    const std::string written = s.fingerprint();
    write_checkpoint(world, scratch.path(), s.particles(), nullptr, {s.global(), s.scale(), "", "{}"},
                     s.wrap(), {"", written, groups}, 1);
    const Simulation read(world, s.scene(), find_checkpoint(world, scratch.path()));
    EXPECT_EQ(read.fingerprint(), written) << "step " << step;
  }
  EXPECT_GT(world.sum(failed), 0);
}

}  // namespace
}  // namespace sph
