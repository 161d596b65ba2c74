// Particles counted without placing them, and what a machine is asked for.
#include <gtest/gtest.h>

#include <numeric>

#include "region_texts.hpp"
#include "run/memory_need.hpp"
#include "sph/models/parts.hpp"
#include "sph/plan/distribution.hpp"
#include "sph/start/placement.hpp"
#include "start/start_count.hpp"
#include "state_fixture.hpp"

namespace sph::test {
namespace {

Scene scene_of(const std::string& top, const std::string& start) {
  return parse_scene(top + R"(
[kernel]
h_over_dx = 1.2
[[group]]
name = "water"
kind = "fluid"
density = 1000
sound_speed = 20
[[group]]
name = "oil"
kind = "fluid"
density = 800
sound_speed = 20
[[group]]
name = "wall"
kind = "wall"
[time]
until = 1
[start]
)" + start,
                     "count.toml", {});
}

std::string cone(const std::string& from, const std::string& to, double radius, double top_radius) {
  return "shape = \"cone\"\nfrom = " + from + "\nto = " + to + "\nradius = " + std::to_string(radius) +
         "\ntop_radius = " + std::to_string(top_radius) + "\n";
}
std::string cylinder(const std::string& from, const std::string& to, double radius) {
  return "shape = \"cylinder\"\nfrom = " + from + "\nto = " + to + "\nradius = " + std::to_string(radius) +
         "\n";
}

const std::string square = "dimension = 2\n[domain]\nlower = [0, -0.5]\nupper = [1, 0.5]\n";
const std::string cube = "dimension = 3\n[domain]\nlower = [0, 0, 0]\nupper = [1, 0.8, 0.6]\n";
const std::string painted_square =
    region("wall", "") + region("water", box("[0.1, -0.4]", "[0.9, 0.5]")) +
    region("none", ball("[0.5, 0.1]", 0.3)) + region("oil", ball("[0.47, 0.13]", 0.171)) +
    region("water", ball("[0.8, 0.45]", 0.12)) + region("oil", box("[0.2, 0]", "[0.25, 0.02]"));
const std::string pointed_square = region("water", "") +
                                   region("oil", cone("[0.5, -0.4]", "[0.5, 0.3]", 0.4, 0.05)) +
                                   region("none", cylinder("[0.2, -0.1]", "[0.7, -0.1]", 0.05)) +
                                   region("wall", cone("[0.9, 0.2]", "[0.4, 0.2]", 0.1, 0)) +
                                   region("oil", cone("[0.1, 0.3]", "[0.3, 0.3]", 0.02, 0.1));
const std::string pointed_cube = region("water", "") +
                                 region("oil", cone("[0.5, 0.4, 0.05]", "[0.5, 0.4, 0.5]", 0.35, 0.1)) +
                                 region("none", cylinder("[0.5, 0.4, 0]", "[0.5, 0.4, 0.6]", 0.07)) +
                                 region("wall", cylinder("[0.1, 0.3, 0.3]", "[0.9, 0.3, 0.3]", 0.06)) +
                                 region("oil", cone("[0.9, 0.6, 0.3]", "[0.2, 0.6, 0.3]", 0.15, 0)) +
                                 region("wall", cone("[0.2, 0.1, 0.1]", "[0.8, 0.1, 0.1]", 0, 0.1)) +
                                 region("oil", cone("[0.3, 0.7, 0.5]", "[0.3, 0.3, 0.5]", 0.05, 0.2));
const std::string painted_cube =
    region("wall", "") + region("water", box("[0.1, 0.1, 0.1]", "[0.9, 0.7, 0.6]")) +
    region("none", box("[0.1, 0.1, 0.4]", "[0.5, 0.7, 0.6]")) +
    region("oil", ball("[0.6, 0.4, 0.3]", 0.233)) + region("water", ball("[0.61, 0.4, 0.3]", 0.05)) +
    region("oil", ball("[0.95, 0.75, 0.55]", 0.2));

std::string polygon(const std::string& points) { return "shape = \"polygon\"\npoints = " + points + "\n"; }
std::string ring(const std::string& origin, double scale) {
  return "shape = \"mesh\"\nfile = \"" PEPERITE_TEST_DIR "/scenes/ring.obj\"\norigin = " + origin +
         "\nscale = " + std::to_string(scale) + "\n";
}
const std::string bays_of_square =
    region("water", "") +
    region("oil", polygon("[[0.1, -0.4], [0.9, -0.3], [0.8, 0.4], [0.6, -0.2], [0.3, 0.45]]")) +
    region("none", polygon("[[0.2, -0.1], [0.7, 0.1], [0.7, -0.1], [0.2, 0.1]]")) +
    region("wall", ball("[0.5, 0.2]", 0.1));
const std::string bays_of_cube = region("water", "") + region("oil", ring("[0.5, 0.4, 0.3]", 0.25)) +
                                 region("none", ring("[0.2, 0.1, 0.5]", 0.2)) +
                                 region("wall", ball("[0.5, 0.4, 0.3]", 0.1));

class StartCounts : public ::testing::Test {
 protected:
  void expect_as_placed(const Scene& scene) {
    const PositionScale scale = position_scale(scene);
    Distribution distribution(world_, scene, scale);
    Particles particles(scene.dim, Parts(world_, scene, scale).sets.front().fields);
    place_particles(scene, scale, distribution, particles);
    std::vector<std::int64_t> placed(scene.groups.size(), 0);
    for (std::size_t i = 0; i < particles.owned(); ++i) ++placed[particles.data<Field::group>()[i]];
    world_.sum(std::span<std::int64_t>(placed));
    const StartCount count = count_start(world_, scene);
    EXPECT_EQ(count.by_group, placed);
    EXPECT_EQ(count.all, std::accumulate(placed.begin(), placed.end(), std::int64_t{0}));
    EXPECT_GT(count.all, 100);
  }
  std::string refusal(const Scene& scene) {
    try {
      require_memory(world_, scene);
    } catch (const InputError& error) {
      return error.what();
    }
    return "(accepted)";
  }
  decomp::Comm world_{MPI_COMM_WORLD};
};

TEST_F(StartCounts, EqualWhatIsPlaced) {
  for (const char* spacing : {"0.05", "0.031", "0.02", "0.0237"}) {
    SCOPED_TRACE(spacing);
    const std::string dx = std::string("spacing = ") + spacing + "\n";
    expect_as_placed(scene_of(square, dx + painted_square));
    expect_as_placed(scene_of(square, dx + "lattice = \"hexagonal\"\n" + painted_square));
    expect_as_placed(scene_of(square, dx +
                                          "origin = [0.013, -0.211]\nlower = [0.003, -0.5]\nupper = "
                                          "[0.97, 0.4]\njitter = 0.2\n" +
                                          painted_square));
    expect_as_placed(scene_of(square, dx + pointed_square));
    expect_as_placed(scene_of(cube, dx + pointed_cube));
    expect_as_placed(scene_of(cube, dx + "lattice = \"fcc\"\n" + pointed_cube));
    expect_as_placed(scene_of(cube, dx + painted_cube));
    expect_as_placed(scene_of(cube, dx + "lattice = \"fcc\"\n" + painted_cube));
    expect_as_placed(scene_of(square, dx + bays_of_square));
    expect_as_placed(scene_of(square, dx + "lattice = \"hexagonal\"\n" + bays_of_square));
    expect_as_placed(scene_of(cube, dx + bays_of_cube));
    expect_as_placed(scene_of(cube, dx + "lattice = \"fcc\"\n" + bays_of_cube));
  }
}

TEST_F(StartCounts, OfCylindersAndConesAreTheirVolumes) {
  const double dx = 0.01, cell = dx * dx * dx, pi = 3.14159265358979;
  const auto volume = [&](const std::string& shape) {
    return cell * static_cast<double>(
                      count_start(world_, scene_of(cube, "spacing = 0.01\n" + region("oil", shape))).all);
  };
  EXPECT_NEAR(volume(cylinder("[0.2, 0.4, 0.3]", "[0.7, 0.4, 0.3]", 0.2)), pi * 0.04 * 0.5, 6e-4);
  EXPECT_NEAR(volume(cylinder("[0.4, 0.7, 0.3]", "[0.4, 0.2, 0.3]", 0.2)), pi * 0.04 * 0.5, 6e-4);
  EXPECT_NEAR(volume(cone("[0.4, 0.4, 0.1]", "[0.4, 0.4, 0.5]", 0.3, 0)), pi * 0.09 * 0.4 / 3, 6e-4);
  EXPECT_NEAR(volume(cone("[0.6, 0.4, 0.3]", "[0.2, 0.4, 0.3]", 0.1, 0.2)), pi * 0.07 * 0.4 / 3, 6e-4);
}

// Each point has 12 neighbours at 2^(1/6) spacings and none nearer, through periods too, and a volume of spacing^3.
TEST_F(StartCounts, CloseInThreeDimensions) {
  const std::string periods =
      "dimension = 3\n[domain]\nlower = [0, 0, 0]\nupper = [1, 1.2, 1.4]\nperiodic = [true, "
      "true, true]\n[decomposition]\nskin = 0\n";
  const double edge = 0.1, spacing = edge / fcc_edge;
  const std::string start =
      "lattice = \"fcc\"\nspacing = " + std::to_string(spacing) + "\n[[start.region]]\ngroup = \"water\"\n";
  const Scene scene = scene_of(periods, start);
  const PositionScale scale = position_scale(scene);
  const decomp::Comm alone(MPI_COMM_SELF);
  Distribution distribution(alone, scene, scale);
  Particles p(3, Parts(alone, scene, scale).sets.front().fields);
  place_particles(scene, scale, distribution, p);
  ASSERT_EQ(p.owned(), 4U * 10 * 12 * 14);
  const double length[]{1, 1.2, 1.4}, near = edge / std::sqrt(2.0);
  double mass = 0;
  for (std::size_t i = 0; i < p.owned(); ++i) mass += p.data<Field::mass>()[i];
  for (std::size_t i = 0; i < p.owned(); i += 41) {
    int touching = 0;
    for (std::size_t j = 0; j < p.owned(); ++j) {
      double apart = i == j ? 1 : 0;
      for (std::size_t a = 0; a < 3; ++a) {
        const double x =
            scale.metres(p.data<Field::position>()[3 * j + a] - p.data<Field::position>()[3 * i + a]);
        const double across = x - length[a] * std::nearbyint(x / length[a]);
        apart += across * across;
      }
      EXPECT_GT(apart, near * near * (1 - 1e-4));
      touching += apart < near * near * 1.01 ? 1 : 0;
    }
    EXPECT_EQ(touching, 12);
  }
  EXPECT_NEAR(mass, scene.groups[0].density * 1.2 * 1.4, 1e-3 * mass);
}

TEST_F(StartCounts, RefuseAPeriodThatCutsCubes) {
  const std::string periods =
      "dimension = 3\n[domain]\nlower = [0, 0, 0]\nupper = [1, 1, 1]\nperiodic = [true, false, false]\n";
  try {
    (void)scene_of(periods, "lattice = \"fcc\"\nspacing = 0.1\n[[start.region]]\ngroup = \"water\"\n");
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("divides the periodic length in x into 6.29961 cells"),
              std::string::npos)
        << error.what();
  }
}

TEST_F(StartCounts, OfMoreThanAnyMachineHoldsTakeNoMemory) {
  const StartCount count = count_start(world_, scene_of(square, "spacing = 1e-5\n" + painted_square));
  EXPECT_EQ(count.all, count.by_group[0] + count.by_group[1] + count.by_group[2]);
  EXPECT_NEAR(static_cast<double>(count.all), 1e10, 0.2e10);
}

TEST_F(StartCounts, RefuseWhatTheMachineCannotHold) {
  const std::string sph = refusal(scene_of(square, "spacing = 1e-5\n" + painted_square));
  for (const char* part : {"start: ", " particles in ", " cells need ", " TB", "the machine has ", " GB"})
    EXPECT_NE(sph.find(part), std::string::npos) << sph;
  // Few particles in a wide domain take little: memory follows the cells that hold any.
  const std::string few = refusal(scene_of(
      "dimension = 3\n[domain]\nlower = [0, 0, 0]\nupper = [5000, 5000, 5000]\n",
      "spacing = 1e-2\nupper = [0.1, 0.1, 0.1]\n" + region("water", box("[0, 0, 0]", "[0.1, 0.1, 0.1]"))));
  EXPECT_EQ(few, "(accepted)");
  EXPECT_EQ(refusal(scene_of(square, "spacing = 1e-2\n" + painted_square)), "(accepted)");
}

TEST_F(StartCounts, ShareOfTheMachine) {
  MemoryNeed need;
  need.bytes = 3e12;
  EXPECT_EQ(memory_problem(need, {24e9, 1.0 / 200}), "");
  EXPECT_NE(memory_problem(need, {24e9, 1.0 / 100}).find("3 TB, 30 GB on each machine"), std::string::npos);
  EXPECT_EQ(memory_problem(need, {24e9, 1.0 / 100}, 1.5), "");
  // Meshes are there once a machine, mesh regions once a rank.
  need = {.meshes = 5e9, .regions = 2e9};
  EXPECT_EQ(memory_problem(need, {24e9, 1.0 / 200, 9}), "");
  EXPECT_NE(memory_problem(need, {24e9, 1.0 / 200, 10}).find("meshes 25 GB on each machine"),
            std::string::npos);
  EXPECT_EQ(bytes_text(999), "0.999 kB");
  EXPECT_EQ(bytes_text(3.1e12), "3.1 TB");
}

}  // namespace
}  // namespace sph::test
