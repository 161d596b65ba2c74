// Scenes of grains as whole runs: histories that must not be lost, what a smooth scene does without, walls,
// and the hard cases of a contact.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <utility>

#include "grain_fixture.hpp"
#include "run/cost.hpp"
#include "sph/laws/contact/law.hpp"

namespace sph {
namespace {

using test::grain;
using test::StartGrain;

/// Without grains, walls and time.
const std::string sand = R"(
dimension = 3
[domain]
lower = [0, 0, 0]
upper = [0.012, 0.006, 0.03]
gravity = [0, 0, -9.81]
[contact]
law = "linear"
[[group]]
name = "sand"
kind = "grain"
density = 2500
diameter = [0.0008, 0.001]
normal_stiffness = 100
restitution = 0.5
friction = 0.5
)";
const std::string box = R"(
[[wall]]
name = "box"
material = "sand"
shape = "box"
lower = [0, 0, 0]
upper = [0.012, 0.006, 0.03]
)";
const std::string fill = R"(
[start]
spacing = 0.00105
upper = [0.01155, 0.00525, 0.0063]
jitter = 0.02
velocity = [0.2, 0.1, -0.1]
[[start.region]]
group = "sand"
[time]
dt = 6e-6
steps = 1
)";

Scene filled_box(std::vector<std::string> overrides = {}) {
  return parse_scene(sand + box + fill, "box", overrides);
}

void run(Simulation& simulation, int steps) {
  for (int k = 0; k < steps; ++k) simulation.step();
}

const decomp::Comm& world() {
  static const decomp::Comm comm(MPI_COMM_WORLD);
  return comm;
}
const decomp::Comm& self() {
  static const decomp::Comm comm(MPI_COMM_SELF);
  return comm;
}

/// The entries without the one at `lost`.
decomp::Payload without(const decomp::Payload& all, std::size_t lost, std::size_t entry) {
  decomp::Payload out = all;
  const auto at = out.bytes.begin() + static_cast<std::ptrdiff_t>(lost * entry);
  out.bytes.erase(at, at + static_cast<std::ptrdiff_t>(entry));
  for (std::uint64_t& offset : out.offset)
    if (offset > lost * entry) offset -= entry;
  return out;
}

TEST(GrainRuns, LostHistoryIsMissed) {
  Simulation simulation(self(), filled_box());
  run(simulation, 2000);
  const Particles& p = simulation.particles();
  const Distribution& d = simulation.distribution();
  const decomp::Payload entries = simulation.contacts();
  const ContactLists& old = simulation.grains()->pairs().lists();
  ASSERT_GT(entries.bytes.size(), 100 * old.entry_bytes());
  WallsNow walls;
  for (const Wall& wall : simulation.scene().grains.walls) {
    walls.planes.push_back({{}, wall.normal, {}, 0, true});
    for (std::size_t a = 0; a < 3; ++a)
      walls.planes.back().point[a] = simulation.scale().quanta(wall.point[a]);
  }
  std::vector<std::uint32_t> order(p.owned());
  std::iota(order.begin(), order.end(), 0u);
  const auto lists_with = [&](const decomp::Payload& payload) {
    ContactLists lists(old.parities());
    lists.build(p, d.grid(), d.own_cells(), d.list_radius(), d.skin(), simulation.scale().quantum,
                simulation.sets().front().ranges, {false}, walls);
    const ContactCensus found = lists.unpack(p, payload, order, simulation.scale().quantum, walls);
    return std::pair(std::move(lists), found);
  };
  const ContactCensus sent = ContactLists::census(p, entries, old.history());
  const auto [whole, all] = lists_with(entries);
  EXPECT_EQ(all, sent);
  // Where one rank has both sides of a pair it needs only one of the two entries.
  std::size_t needed = 0;
  const std::size_t count = entries.bytes.size() / old.entry_bytes();
  for (std::size_t lost = 0; lost < count; ++lost) {
    const auto [lists, found] = lists_with(without(entries, lost, old.entry_bytes()));
    const bool same = lists.pack(p).bytes == whole.pack(p).bytes;
    EXPECT_EQ(found == sent, same) << lost;
    needed += same ? 0 : 1;
    // A partner that is another grain, though the number is right.
    decomp::Payload wrong = entries;
    const std::uint64_t key = wall_key - 1;
    std::memcpy(wrong.bytes.data() + lost * old.entry_bytes(), &key, sizeof key);
    EXPECT_NE(ContactLists::census(p, wrong, old.history()), sent) << lost;
  }
  EXPECT_GE(2 * needed, count);
}

TEST(GrainRuns, SmoothGrainsNeitherSpinNorRemember) {
  const Scene rough = filled_box(), smooth = filled_box({"group.sand.friction="});
  Simulation simulation(world(), smooth);
  run(simulation, 200);
  EXPECT_FALSE(simulation.particles().has(Field::spin));
  EXPECT_FALSE(simulation.has_history());
  EXPECT_TRUE(simulation.contacts().bytes.empty());
  for (const ContactGroups* groups :
       {&simulation.grains()->pairs().lists().pairs(), &simulation.grains()->pairs().lists().walls()})
    EXPECT_EQ(groups->history.size(), 0U);
  EXPECT_EQ(bytes_of(grain_fields(rough), 3) - bytes_of(grain_fields(smooth), 3), 3 * sizeof(double));
  EXPECT_GT(world().sum(simulation.grains()->pairs().lists().pairs().contacts()), 0);
  EXPECT_EQ(world().sum(simulation.grains()->pairs().counters().created), 0);  // nothing to count by
}

TEST(GrainRuns, ServoReachesItsForce) {
  const std::string piston = R"(
[[wall]]
name = "piston"
material = "sand"
point = [0, 0, 0.0065]
normal = [0, 0, -1]
force = 0.02
servo_gain = 6
largest_speed = 0.2
)";
  Simulation simulation(world(),
                        parse_scene(sand + box + piston + fill, "piston", {"wall.box.open=[\"z1\"]"}));
  run(simulation, 16000);
  double mean = 0, least = 1;
  constexpr int some = 2000;
  const std::size_t w = simulation.global().walls.size() - 1;
  for (int k = 0; k < some; ++k) {
    simulation.step();
    const double force = simulation.grains()->walls().newton(simulation.global().walls[w].force[2]);
    mean += force / some;
    least = std::min(least, force);
  }
  EXPECT_NEAR(mean, 0.02, 2e-4);
  EXPECT_GT(least, 0.01);
  EXPECT_LT(simulation.global().walls[w].offset[2], 0);
}

TEST(GrainRuns, WallPushesWithItsVelocity) {
  const std::string paddle = R"(
[[wall]]
name = "paddle"
material = "sand"
point = [0.002, 0, 0]
normal = [1, 0, 0]
velocity = [0.25, 0, 0]
)";
  const test::StartFile file(world(), {{"sand", {0.0026, 0.003, 0.01}, {0, 0, 0}, {}, 0.0005}});
  Scene scene =
      parse_scene(sand + paddle + "[start]\nfile = \"" + file.path() + "\"\n[time]\ndt = 1e-6\nsteps = 1\n",
                  "paddle", {"domain.gravity=[0, 0, 0]"});
  Simulation simulation(world(), scene);
  constexpr int steps = 4000;
  run(simulation, steps);
  const double way = simulation.scale().metres(simulation.global().walls[0].offset[0]);
  EXPECT_NEAR(way, steps * 1e-6 * 0.25, 1e-9);
  EXPECT_NEAR(grain(simulation, 0).v[0], 1.5 * 0.25, 2e-3);  // (1 + e) times the wall's
}

TEST(GrainRuns, HugeFrictionAgreesOnAnyRanks) {
  for (const char* friction : {"group.sand.friction=10", "group.sand.friction="}) {
    Scene scene = filled_box({friction});
    Simulation alone(self(), scene);
    scene.decomposition.cuts = CutRule::chaos;
    Simulation shared(world(), scene);
    run(alone, 1500);
    run(shared, 1500);
    EXPECT_EQ(alone.fingerprint(), shared.fingerprint()) << friction;
    EXPECT_LT(kinetic_energy(alone), kinetic_energy(Simulation(self(), scene))) << friction;
  }
}

TEST(GrainRuns, OverlappingStartIsRefused) {
  try {
    Simulation simulation(world(), filled_box({"start.spacing=0.0006"}));
    FAIL();
  } catch (const InputError& e) {
    for (const char* part :
         {"start: grain ", " and grain ", " overlap by ", "contact.largest_overlap", "start.spacing"})
      EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
  }
}

// Grains that have come to rest stay so: contacts make no heat.
TEST(GrainRuns, QuasiStaticBoxStaysCold) {
  if (world().size() > 1) GTEST_SKIP() << "one rank is enough";
  // The rolling spring has no dashpot: below its limit it swings on, but takes up nothing.
  for (const char* rolling : {"group.sand.rolling_friction=0", "group.sand.rolling_friction=0.05"}) {
    Simulation simulation(self(), filled_box({rolling, "contact.tangential_damping=1"}));
    run(simulation, 70000);
    double mass = 0;
    for (std::size_t i = 0; i < simulation.particles().owned(); ++i)
      mass += simulation.particles().data<Field::mass>()[i];
    const double potential = mass * 9.81 * 0.003, settled = kinetic_energy(simulation);
    EXPECT_LT(settled, 1e-7 * potential) << rolling;
    double last = settled;
    for (int k = 0; k < 8; ++k) {
      run(simulation, 10000);
      last = kinetic_energy(simulation);
      EXPECT_LT(last, 2 * settled) << rolling << ' ' << k;
    }
    const bool rolls = simulation.grains()->pairs().lists().history() > 3;
    EXPECT_LT(last, (rolls ? 1e-7 : 1e-8) * potential) << rolling;
  }
}

}  // namespace
}  // namespace sph
