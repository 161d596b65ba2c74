// Two sets of particles in one scene, a fluid and grains that do not act on each other: each does what it does
// alone, and both are the same bits on any ranks, with any cuts and after restarts.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "grain_fixture.hpp"
#include "state_fixture.hpp"

namespace sph {
namespace {

const std::string domain = R"(
dimension = 3
[domain]
lower = [0, 0, -0.002]
upper = [0.0075, 0.0075, 0.012]
periodic = [true, true, false]
gravity = [0, 0, -9.81]
[time]
dt = 1e-5
steps = 1
)";
const std::string water = domain + R"(
[[group]]
name = "water"
kind = "fluid"
density = 1000
sound_speed = 10
viscosity = 0.01
[kernel]
smoothing_length = 0.0006
[start]
spacing = 0.0005
lower = [0, 0, 0]
upper = [0.0075, 0.0075, 0.008]
jitter = 0.1
seed = 3
velocity = [0.4, 0.1, 0]
[[start.region]]
group = "water"
)";
const std::string sand = R"(
[contact]
law = "linear"
tangential_damping = 0.5
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
velocity = [0, 0, 0.3]
)";

constexpr int steps = 160;

/// Of the fluid, with the grains of a scene of sand beside it.
Scene both(const std::vector<std::string>& more = {}) {
  Scene scene = parse_scene(water, "water", more);
  const Scene grains =
      parse_scene(domain + sand +
                      "[start]\nspacing = 0.00125\nlower = [0, 0, 0]\nupper = [0.0075, 0.0075, 0.003]\n"
                      "[[start.region]]\ngroup = \"sand\"\n",
                  "sand", {});
  const int group = static_cast<int>(scene.groups.size());
  scene.groups.push_back(grains.groups.front());
  scene.grains.contact = grains.grains.contact;
  scene.grains.walls = grains.grains.walls;
  for (Wall& wall : scene.grains.walls) wall.group = group;
  scene.start.fills.push_back({group, {0, 0, 0.0002}, {0.0075, 0.0075, 0.004}, 0.00107});
  return scene;
}

const decomp::Comm& world() {
  static const decomp::Comm comm(MPI_COMM_WORLD);
  return comm;
}
const decomp::Comm& self() {
  static const decomp::Comm comm(MPI_COMM_SELF);
  return comm;
}

/// After each step on one rank.
const std::vector<std::string>& expected() {
  static const std::vector<std::string> prints = [] {
    Simulation s(self(), both());
    std::vector<std::string> out;
    for (int k = 0; k < steps; ++k) s.step(), out.push_back(s.fingerprint());
    return out;
  }();
  return prints;
}

/// Values of a field of this rank's particles, by id.
template <Field F>
std::map<std::uint64_t, std::vector<field_type<F>>> values(const Particles& p) {
  const auto n = static_cast<std::size_t>(components(info(F).shape, p.dim()));
  std::map<std::uint64_t, std::vector<field_type<F>>> out;
  for (std::size_t i = 0; i < p.owned(); ++i)
    out[p.data<Field::id>()[i]].assign(p.data<F>() + i * n, p.data<F>() + (i + 1) * n);
  return out;
}

/// Of the first set, in the domain: rows are brought back into it with new lists, and these come when they must.
std::map<std::uint64_t, std::vector<std::int64_t>> places(const Simulation& s) {
  auto all = values<Field::position>(s.particles(0));
  for (auto& [id, place] : all)
    for (std::size_t a = 0; a < place.size(); ++a) place[a] = s.wrap()(static_cast<int>(a), place[a]);
  return all;
}

TEST(Sets, FluidBesideGrainsIsThatAlone) {
  Simulation alone(self(), parse_scene(water, "water", {})), beside(self(), both());
  ASSERT_EQ(beside.sets().size(), 2U);
  for (int k = 0; k < steps; ++k) alone.step(), beside.step();
  EXPECT_EQ(places(alone), places(beside));
  EXPECT_EQ(values<Field::velocity>(alone.particles()), values<Field::velocity>(beside.particles(0)));
  EXPECT_EQ(values<Field::density>(alone.particles()), values<Field::density>(beside.particles(0)));
}

// Alone, a step of grains ends with their drift; in company it begins with it. They start at rest: velocities
// agree after each step, positions a step later.
TEST(Sets, GrainsBesideFluidAreThoseAlone) {
  const std::vector<std::string> at_rest{"domain.gravity=[10, 0, -300]"};
  Scene scene = both({"start.velocity=\"rest\"", at_rest.front()});
  scene.grains.walls.front().velocity = {};
  Simulation beside(self(), scene);
  const Particles& p = beside.particles(1);
  std::vector<std::size_t> rows(p.owned());
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = i;
  std::ranges::sort(rows, {}, [&](std::size_t i) { return p.data<Field::id>()[i]; });
  std::vector<test::StartGrain> start;
  for (const std::size_t i : rows) {
    test::StartGrain g{"sand", {}, {}, {}, p.data<Field::radius>()[i]};
    for (std::size_t a = 0; a < 3; ++a) g.x[a] = beside.scale().metres(p.data<Field::position>()[i * 3 + a]);
    start.push_back(g);
  }
  ASSERT_GT(start.size(), 100U);
  const test::StartFile file(self(), start);
  Simulation alone(self(), parse_scene(domain + sand + "[start]\nfile = \"" + file.path() + "\"\n", "sand",
                                       {at_rest.front(), "wall.floor.velocity=[0, 0, 0]"}));
  ASSERT_EQ(alone.scale().quantum, beside.scale().quantum);
  const auto in_order = [](const auto& by_id) {
    std::vector<typename std::decay_t<decltype(by_id)>::mapped_type> out;
    for (const auto& [id, value] : by_id) out.push_back(value);
    return out;
  };
  beside.step();
  for (int k = 0; k < 2 * steps; ++k) {
    alone.step();
    ASSERT_EQ(in_order(values<Field::velocity>(alone.particles())),
              in_order(values<Field::velocity>(beside.particles(1))));
    ASSERT_EQ(in_order(values<Field::spin>(alone.particles())),
              in_order(values<Field::spin>(beside.particles(1))));
    ASSERT_EQ(alone.global().walls[0].force, beside.global().walls[0].force) << k;
    beside.step();
    ASSERT_EQ(in_order(values<Field::position>(alone.particles())),
              in_order(values<Field::position>(beside.particles(1))));
  }
  EXPECT_GT(alone.grains()->pairs().counters().created, 60);
}

TEST(Sets, AnyRanksCutsAndSkinsGiveTheSameBits) {
  for (const char* skin : {"0", "1e-3", "0.3"}) {
    Simulation s(world(),
                 both({std::string("decomposition.skin=") + skin, "decomposition.balance=\"chaos\""}));
    for (std::size_t k = 0; k < steps; ++k) {
      s.step();
      ASSERT_EQ(s.fingerprint(), expected()[k]) << skin << ' ' << k;
    }
    if (world().size() > 1) {
      EXPECT_GT(world().sum(s.distribution().migrated()), 0);
    }
  }
}

TEST(Sets, RestartsDoToo) {
  const test::ScratchDirectory dir(world());
  const Scene scene = both({"decomposition.balance=\"chaos\""});
  auto s = std::make_unique<Simulation>(world(), scene);
  for (std::size_t k = 0; k < steps; ++k) {
    s->step();
    if (k % 16 != 7) continue;
    s = test::through_a_checkpoint(*s, dir.path());
    ASSERT_EQ(s->fingerprint(), expected()[k]) << k;
  }
  EXPECT_EQ(s->fingerprint(), expected().back());
}

}  // namespace
}  // namespace sph
