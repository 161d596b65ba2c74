// Scenes of grains: defaults, units, the rules between keys, and the exact round trip through to_toml.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "sph/laws/contact/law.hpp"
#include "sph/scene/scene.hpp"

namespace {

namespace fs = std::filesystem;
using Options = std::vector<std::string>;
using sph::Double3;

const std::string small = R"(
[domain]
lower = [0, 0, 0]
upper = [1, 1, 1]
[contact]
law = "linear"
[[group]]
name = "sand"
kind = "grain"
density = 2000
diameter = 0.02
normal_stiffness = 700
restitution = 0.5
[[group]]
name = "glass"
kind = "grain"
normal_stiffness = 7000
restitution = 0.9
[[wall]]
name = "floor"
material = "glass"
point = [0, 0, 0]
normal = [0, 0, 2]
[[start.region]]
group = "sand"
[time]
until = 1
)";
const Options hertz{"contact.law=hertz",
                    "group.sand.normal_stiffness=",
                    "group.glass.normal_stiffness=",
                    "group.sand.young_modulus=10 MPa",
                    "group.sand.poisson_ratio=0.3",
                    "group.glass.young_modulus=1 GPa",
                    "group.glass.poisson_ratio=0.5"};
const std::string servo = R"(
[[wall]]
name = "lid"
material = "glass"
point = [0, 0, 1]
normal = [0, 0, -1]
force = 5
servo_gain = 0.01
largest_speed = 0.1
[[stage]]
name = "rest"
begin = 0
[[stage.wall]]
name = "lid"
velocity = [0, 0, -0.1]
[[stage]]
name = "go"
begin = 0.5
[[stage.wall]]
name = "lid"
remove = true
[[stage.wall]]
name = "floor"
velocity = [0.1, 0, 0]
)";

sph::Scene parse(const std::string& text, const Options& options = {}) {
  return sph::parse_scene(text, "dir/small.toml", options);
}

Options operator+(Options a, const Options& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::string message_of(const std::string& text, const Options& options = {}) {
  try {
    (void)parse(text, options);
  } catch (const sph::InputError& e) {
    return e.what();
  }
  return "(accepted)";
}

void expect_round_trip(const sph::Scene& s) {
  const std::string text = sph::to_toml(s);
  const sph::Scene again = sph::parse_scene(text, s.file, {});
  EXPECT_EQ(again, s) << text;
  EXPECT_EQ(sph::to_toml(again), text);
}

TEST(GrainScene, Defaults) {
  const sph::Scene s = parse(small);
  EXPECT_TRUE(s.of_grains());
  EXPECT_EQ(s.dim, 3);
  EXPECT_EQ(s.support(), 0.02);
  EXPECT_EQ(s.start.spacing, 1.1 * 0.02);
  EXPECT_EQ(s.decomposition.skin, 0.3);
  EXPECT_FALSE(s.time.dt.has_value());
  EXPECT_EQ(s.grains.contact.law->word, "linear");
  sph::ContactControl plain;
  plain.law = s.grains.contact.law;
  EXPECT_EQ(s.grains.contact, plain);
  EXPECT_EQ(s.groups[0].grain.least_radius, 0.01);
  EXPECT_EQ(s.groups[0].grain.largest_radius, 0.01);
  EXPECT_EQ(s.groups[0].grain.constants[1], 200);
  EXPECT_EQ(s.groups[0].grain.friction, 0);
  EXPECT_FALSE(s.groups[0].grain.fixed);
  EXPECT_EQ(s.groups[1].grain.largest_radius, 0);
  EXPECT_EQ(s.start.velocity.kind, sph::InitialVelocity::rest);
  EXPECT_EQ(s.output, sph::OutputControl{});
  EXPECT_EQ(s.start.tile, sph::Tile{});
}

// Of grains as large as each other lists reach the furthest.
TEST(GrainScene, SkinFollowsTheSizes) {
  EXPECT_DOUBLE_EQ(parse(small, {"group.sand.diameter=[0.016, 0.02]"}).decomposition.skin, 0.27);
  EXPECT_DOUBLE_EQ(parse(small, {"group.glass.diameter=0.012", "group.glass.density=1"}).decomposition.skin,
                   0.24);
  EXPECT_EQ(parse(small, {"group.sand.diameter=[0.002, 0.02]"}).decomposition.skin, 0.2);
  EXPECT_EQ(parse(small, {"decomposition.skin=0.06"}).decomposition.skin, 0.06);
}

TEST(GrainScene, LargestGrainDecides) {
  const sph::Scene s = parse(small, {"group.sand.diameter=[\"1 cm\", 0.03]", "group.glass.diameter=0.04",
                                     "group.glass.density=1", "start.spacing=0.05"});
  EXPECT_EQ(s.groups[0].grain.least_radius, 0.005);
  EXPECT_EQ(s.groups[0].grain.largest_radius, 0.015);
  EXPECT_EQ(s.support(), 0.04);
  EXPECT_EQ(s.start.spacing, 0.05);
  expect_round_trip(s);
}

TEST(GrainScene, UnitsGiveTheSameBitsAsTheNumber) {
  const auto stiffness = [](const std::string& value) {
    return parse(small, {"group.sand.normal_stiffness=" + value}).groups[0].grain.constants[0];
  };
  EXPECT_EQ(stiffness("1 kN/m"), 1000);
  EXPECT_EQ(stiffness("0.7 N/mm"), 700);
  EXPECT_EQ(stiffness("3 kg/s2"), 3);
  EXPECT_EQ(parse(small, {"group.sand.diameter=9.3 mm"}).groups[0].grain.largest_radius, 0.5 * 0.0093);
  EXPECT_EQ(parse(small, hertz).groups[0].grain.constants[0], 1e7);
  const Options undamped{"group.sand.restitution=", "group.glass.restitution="};
  EXPECT_EQ(parse(small, undamped + Options{"contact.normal_damping=50 1/s"}).grains.contact.normal_damping,
            50);
  EXPECT_EQ(parse(small, undamped + Options{"contact.normal_damping=2 Hz"}).grains.contact.normal_damping, 2);
  const sph::Scene s = parse(small + servo, {"wall.lid.force=2 mN", "wall.lid.servo_gain=3 mm/s/N",
                                             "wall.lid.largest_speed=1 cm/s", "stage.go.begin=700 ms"});
  EXPECT_EQ(s.grains.walls[1].force, 0.002);
  EXPECT_EQ(s.grains.walls[1].servo_gain, 0.003);
  EXPECT_EQ(s.grains.walls[1].largest_speed, 0.01);
  EXPECT_EQ(s.grains.stages[1].begin, 0.7);
}

TEST(GrainScene, NormalsAreUnitVectorsThatRoundTrip) {
  EXPECT_EQ(parse(small).grains.walls[0].normal, (Double3{0, 0, 1}));
  EXPECT_EQ(parse(small, {"wall.floor.normal=[0, 0, 1e-320]"}).grains.walls[0].normal, (Double3{0, 0, 1}));
  EXPECT_EQ(parse(small, {"wall.floor.normal=[0, 1e308, 1e308]"}).grains.walls[0].normal,
            parse(small, {"wall.floor.normal=[0, 3, 3]"}).grains.walls[0].normal);
  std::uint64_t state = 1;
  const auto random = [&state] {
    state = state * 6364136223846793005U + 1442695040888963407U;
    return static_cast<double>(state >> 11) * 0x1p-53 + 1e-3;
  };
  for (int k = 0; k < 300; ++k) {
    const sph::Scene s = parse(small, {"wall.floor.normal=[" + std::to_string(random()) + ", " +
                                       std::to_string(random()) + ", " + std::to_string(random()) + "]"});
    const Double3& n = s.grains.walls[0].normal;
    ASSERT_NEAR(n[0] * n[0] + n[1] * n[1] + n[2] * n[2], 1, 1e-15);
    const Double3 again = parse(sph::to_toml(s)).grains.walls[0].normal;
    for (std::size_t a = 0; a < 3; ++a)
      ASSERT_EQ(std::bit_cast<std::uint64_t>(again[a]), std::bit_cast<std::uint64_t>(n[a]));
  }
}

TEST(GrainScene, ABoxIsItsSides) {
  const Options box{"wall.floor.shape=box",
                    "wall.floor.point=", "wall.floor.normal=", "wall.floor.lower=[0, 0.25, 0]",
                    "wall.floor.upper=[1, 0.5, 0.75]"};
  const sph::Scene s = parse(small, box);
  ASSERT_EQ(s.grains.walls.size(), 6U);
  EXPECT_EQ(s.grains.walls[0].name, "floor_x0");
  EXPECT_EQ(s.grains.walls[3].name, "floor_y1");
  EXPECT_EQ(s.grains.walls[3].point[1], 0.5);
  EXPECT_EQ(s.grains.walls[3].normal, (Double3{0, -1, 0}));
  EXPECT_EQ(s.grains.walls[4].normal, (Double3{0, 0, 1}));
  EXPECT_EQ(s.grains.walls[5].point[2], 0.75);
  EXPECT_EQ(s.grains.walls[5].group, 1);
  expect_round_trip(s);
  const Options open{"domain.periodic=[true, false, false]", "wall.floor.open=[\"z1\", \"y0\"]",
                     "start.spacing=0.025"};
  const sph::Scene two = parse(small, box + open);
  ASSERT_EQ(two.grains.walls.size(), 2U);
  EXPECT_EQ(two.grains.walls[0].name, "floor_y1");
  EXPECT_EQ(two.grains.walls[1].name, "floor_z0");
  expect_round_trip(two);
  EXPECT_NE(
      message_of(small, box + Options{"wall.floor.open=[\"y2\"]"}).find("names \"y2\", which is no side"),
      std::string::npos);
  EXPECT_NE(message_of(small, box + open + Options{"wall.floor.open=[\"x0\"]"}).find("y0, y1, z0, z1"),
            std::string::npos);
  EXPECT_NE(message_of(small, box + Options{"wall.floor.velocity=[1, 0, 0]"}).find("a box rests"),
            std::string::npos);
}

TEST(GrainScene, StagesNameWalls) {
  const sph::Scene s = parse(small + servo);
  ASSERT_EQ(s.grains.stages.size(), 2U);
  EXPECT_EQ(s.grains.stages[0].walls[0].wall, 1);
  EXPECT_EQ(s.grains.stages[0].walls[0].velocity, (Double3{0, 0, -0.1}));
  EXPECT_TRUE(s.grains.stages[1].walls[0].remove);
  EXPECT_EQ(s.grains.stages[1].walls[1].wall, 0);
  expect_round_trip(s);
  // A servo that a stage begins has its gain from the start.
  const sph::Scene late =
      parse(small + servo, {"wall.lid.force=", "wall.lid.velocity=[0, 0, -0.1]",
                            "stage.rest.wall.lid.velocity=", "stage.rest.wall.lid.force=3"});
  EXPECT_FALSE(late.grains.walls[1].force.has_value());
  EXPECT_EQ(late.grains.walls[1].servo_gain, 0.01);
  EXPECT_EQ(late.grains.stages[0].walls[0].force, 3);
  expect_round_trip(late);
}

TEST(GrainScene, EveryOptionRoundTrips) {
  const std::string more = servo + R"(
[[contact.pair]]
groups = ["glass", "sand"]
friction = 0.1
[[contact.pair]]
groups = ["sand", "sand"]
rolling_friction = 0
restitution = 1
[[monitor]]
kind = "wall"
wall = "lid"
[[monitor]]
kind = "contacts"
)";
  const Options options{"contact.tangential_damping=1",
                        "contact.pull=true",
                        "contact.largest_overlap=0.5",
                        "group.sand.diameter=[0.013, 0.0171]",
                        "group.sand.tangential_stiffness=3",
                        "group.sand.friction=0.3",
                        "group.sand.rolling_friction=0.01",
                        "group.glass.diameter=0.02",
                        "group.glass.density=1",
                        "group.glass.fixed=true",
                        "group.glass.velocity=[-0.0, 1, 0]",
                        "start.velocity=[0, 0, -1.1]",
                        "start.seed=12345678901",
                        "start.jitter=0.1",
                        "time.dt=1e-5",
                        "time.steps=7",
                        "decomposition.skin=0.1",
                        "output.contacts=true",
                        "output.average_time=0.1"};
  const sph::Scene s = parse(small + more, options);
  EXPECT_EQ(s.grains.contact.pairs[0].groups, (std::array{0, 1}));
  EXPECT_FALSE(s.grains.contact.pairs[0].restitution.has_value());
  EXPECT_EQ(s.grains.contact.pairs[1].groups, (std::array{0, 0}));
  EXPECT_EQ(s.output.monitors[0].wall, 1);
  EXPECT_EQ(s.output.monitors[1].name, "contacts");
  EXPECT_TRUE(s.output.contacts);
  EXPECT_TRUE(s.groups[1].grain.fixed);
  expect_round_trip(s);
  EXPECT_TRUE(std::signbit(parse(sph::to_toml(s)).groups[1].wall.velocity[0]));
  expect_round_trip(parse(small, hertz));
  expect_round_trip(parse(small, {"contact.law=walton_braun"}));
  expect_round_trip(
      parse(small, {"contact.normal_damping=0", "group.sand.restitution=", "group.glass.restitution="}));
}

TEST(GrainScene, FilesAndTilesRoundTrip) {
  const auto start = small.find("[[start.region]]");
  const std::string text = small.substr(0, start) +
                           "[start]\ntile = { file = \"t.h5\", repeat = [3, 1, 2] }\n" +
                           small.substr(small.find("[time]"));
  const sph::Scene s = parse(text);
  EXPECT_EQ(s.start.tile.file, (fs::current_path() / "dir" / "t.h5").string());
  EXPECT_EQ(s.start.tile.repeat, (std::array<std::int64_t, 3>{3, 1, 2}));
  expect_round_trip(s);
  EXPECT_EQ(parse(text, {"start.tile.file=t.h5"}).start.tile.file, (fs::current_path() / "t.h5").string());
  const Options file{"start.tile=", "start.file=t.h5"};
  EXPECT_TRUE(parse(text, file).start.tile.file.empty());
  expect_round_trip(parse(text, file));
  EXPECT_NE(message_of(text, {"start.file=a.csv"}).find("contradicts file"), std::string::npos);
  EXPECT_NE(message_of(text, {"start.velocity=rest"}).find("come from the file"), std::string::npos);
}

TEST(GrainScene, RulesNameTheReason) {
  const std::vector<std::pair<Options, std::string>> cases{
      {{"dimension=2"}, "dimension: is 2; grains are spheres"},
      {{"kernel.h_over_dx=1"},
       "kernel: has no meaning here; there is no kernel where nothing is a fluid or a solid"},
      {{"group.sand.young_modulus=1"},
       "young_modulus: has no meaning here; it is of contact.law = \"hertz\""},
      {hertz + Options{"group.sand.normal_stiffness=1"}, "normal_stiffness: has no meaning here; it is of"},
      {hertz + Options{"contact.normal_damping=1"},
       "contact.normal_damping: has no meaning here; it is of law"},
      {{"contact.normal_damping=1"}, "group.sand.restitution: has no meaning here; contact.normal_damping"},
      {{"group.sand.restitution="}, "group.sand.restitution: is missing"},
      {{"group.sand.kind=solid"}, "group.sand.kind: is \"solid\" beside grains"},
      {{"group.glass.fixed=true"}, "group.glass.fixed: has no meaning here; a material without diameter"},
      {{"group.sand.fixed=true"}, "every group of grains; at least one group must be free"},
      {{"group.sand.diameter="}, "diameter: is missing in every group"},
      {{"start.region.0.group=glass"}, "names \"glass\", a material without diameter"},
      {{"domain.periodic=[true, false, false]"}, "start.spacing: is 0.022 m by default and divides"},
      {{"domain.periodic=[false, false, true]", "start.spacing=0.05"}, "points along z, which is periodic"},
      {{"domain.upper=[0.05, 1, 1]", "domain.periodic=[true, false, false]", "start.spacing=0.025"},
       "reduce the grains or decomposition.skin"},
      {{"wall.floor.normal=[0, 0, -1]"}, "leaves the whole domain behind the wall"},
      {{"start.lattice=hexagonal"}, "exists in 2D only"},
      {{"decomposition.skin=3"}, "of grains: the largest diameter"},
  };
  for (const auto& [options, expected] : cases) {
    const std::string message = message_of(small, options);
    EXPECT_NE(message.find(expected), std::string::npos) << expected << "\ngave " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

}  // namespace
