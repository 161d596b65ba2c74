// Lists, rebuilds and restarts are nobody's business: the same bits with any skin, however fast grains part.
#include <gtest/gtest.h>

#include "grain_fixture.hpp"
#include "sph/checkpoint/checkpoint.hpp"
#include "state_fixture.hpp"

namespace sph {
namespace {

/// Fast grains in a periodic box whose paddle runs after them and whose floor is taken away: contacts of all
/// sorts end in one step and are far apart in the next.
const std::string fast = R"(
dimension = 3
[domain]
lower = [0, 0, -0.004]
upper = [0.0121, 0.0066, 0.012]
periodic = [true, true, false]
gravity = [0, 0, -9.81]
[contact]
law = "linear"
tangential_damping = 0.5
largest_overlap = 0.4
[[group]]
name = "sand"
kind = "grain"
density = 2500
diameter = [0.0008, 0.001]
normal_stiffness = 100
restitution = 0.5
friction = 0.4
rolling_friction = 0.05
[[wall]]
name = "floor"
material = "sand"
point = [0, 0, 0]
normal = [0, 0, 1]
[[wall]]
name = "lid"
material = "sand"
point = [0, 0, 0.0056]
normal = [0, 0, -1]
velocity = [0, 0, -0.5]
[[stage]]
name = "open"
begin = 0.0004
[[stage.wall]]
name = "floor"
remove = true
[start]
spacing = 0.0011
lower = [0, 0, 0.0001]
upper = [0.0121, 0.0066, 0.0055]
jitter = 0.15
seed = 3
velocity = [11, 4, -0.5]
[[start.region]]
group = "sand"
[time]
dt = 15e-6
steps = 1
)";

constexpr int steps = 90;

Scene scene_with(const std::string& skin, std::vector<std::string> more = {}) {
  if (!skin.empty()) more.push_back("decomposition.skin=" + skin);
  return parse_scene(fast, "fast", more);
}

const decomp::Comm& world() {
  static const decomp::Comm comm(MPI_COMM_WORLD);
  return comm;
}

/// After each step on one rank, with the default skin; contacts that began and ended.
struct Expected {
  std::vector<std::string> prints;
  std::int64_t created, ended;
};
const Expected& expected() {
  static const Expected all = [] {
    const decomp::Comm self(MPI_COMM_SELF);
    Simulation s(self, scene_with(""));
    Expected out;
    for (int k = 0; k < steps; ++k) s.step(), out.prints.push_back(s.fingerprint());
    out.created = s.grains()->pairs().counters().created;
    out.ended = s.grains()->pairs().counters().ended;
    return out;
  }();
  return all;
}

TEST(GrainSkins, AnySkinGivesTheSameBits) {
  std::int64_t parted = 0;
  for (const char* skin : {"0", "1e-3", "0.3"})
    for (const bool look : {false, true}) {
      Simulation s(world(), scene_with(skin, {"decomposition.balance=\"chaos\""}));
      for (std::size_t k = 0; k < steps; ++k) {
        s.step();
        // Output may rebuild the lists between steps.
        if (look) s.refresh_contacts();
        parted += static_cast<std::int64_t>(s.grains()->pairs().lists().parted().size());
        ASSERT_EQ(s.fingerprint(), expected().prints[k]) << skin << ' ' << look << ' ' << k;
      }
      const auto& counters = s.grains()->pairs().counters();
      if (world().size() == 1) {
        EXPECT_EQ(counters.created, expected().created) << skin;
        EXPECT_EQ(counters.ended, expected().ended) << skin;
      }
    }
  EXPECT_GT(expected().ended, 100);
  EXPECT_GT(world().sum(parted), 100);
}

// Between looks grains stay in lines (core/grain_lines.hpp) for many steps.
TEST(GrainSkins, NobodyNeedsToLookInBetween) {
  for (const char* skin : {"1e-3", "0.3"}) {
    Simulation s(world(), scene_with(skin));
    for (std::size_t k = 0; k < steps; ++k) s.step();
    EXPECT_EQ(s.fingerprint(), expected().prints.back()) << skin;
  }
}

/// Grains for which lists are good for many steps.
std::vector<std::string> slow() { return {"start.velocity=[0.4,0.2,-0.5]", "stage="}; }

// What one rank reads of its own is no other's business, nor how its messages look.
TEST(GrainSkins, RanksMayLookAlone) {
  const decomp::Comm self(MPI_COMM_SELF);
  Simulation alone(self, scene_with("0.5", slow())), s(world(), scene_with("0.5", slow()));
  const std::size_t set = s.grains()->set();
  for (int k = 0; k < steps; ++k) {
    alone.step(), s.step();
    const bool looks = world().rank() == k % world().size();
    EXPECT_TRUE(!looks || s.particles(set).data<Field::position>() != nullptr);
    s.refresh_contacts();
  }
  EXPECT_EQ(s.fingerprint(), alone.fingerprint());
  EXPECT_LT(s.rebuilds(), steps / 2);
}

// Pairs that do not touch are not looked at until they may. With new lists in every step all of them are.
TEST(GrainSkins, PairsThatSleepWakeInTime) {
  const auto with = [&](const char* skin, const char* every) {
    std::vector<std::string> more = slow();
    more.push_back(std::string("decomposition.rebuild_every=") + every);
    return scene_with(skin, more);
  };
  const decomp::Comm self(MPI_COMM_SELF);
  Simulation awake(self, with("0.5", "1")), asleep(world(), with("0.5", "0"));
  for (int k = 0; k < 250; ++k) awake.step(), asleep.step();
  EXPECT_EQ(asleep.fingerprint(), awake.fingerprint());
  EXPECT_GT(awake.grains()->pairs().counters().created, 1000);
  EXPECT_LT(asleep.rebuilds(), 40);
}

TEST(GrainSkins, RestartsBetweenAnyStepsDoToo) {
  for (const char* skin : {"0", "1e-3"}) {
    test::ScratchDirectory dir(world());
    const Scene scene = scene_with(skin);
    auto s = std::make_unique<Simulation>(world(), scene);
    for (std::size_t k = 0; k < steps; ++k) {
      s->step();
      if (k < 20 || k >= 50) continue;  // around the step that takes the floor away
      if (k % 2 == 1) s->refresh_contacts();
      ASSERT_EQ(s->fingerprint(), expected().prints[k]) << skin << ' ' << k;
      const decomp::Payload contacts = s->contacts();
      write_checkpoint(world(), dir.path(), s->particles(), &contacts, {s->global(), s->scale(), "", "{}"},
                       s->wrap(), {"", s->fingerprint(), {"sand"}}, 1);
      s = std::make_unique<Simulation>(world(), scene, find_checkpoint(world(), dir.path()));
      ASSERT_EQ(s->fingerprint(), expected().prints[k]) << skin << ' ' << k;
    }
    EXPECT_EQ(s->fingerprint(), expected().prints.back()) << skin;
  }
}

}  // namespace
}  // namespace sph
