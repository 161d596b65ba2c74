// How long lists of grains last: bounds on ways to walls against all of them, and the bits of lists made in every step.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "grain_fixture.hpp"
#include "sph/pairs/wall_ways.hpp"

namespace sph {
namespace {

constexpr double quantum = 0x1p-40;

/// Numbers in [-1, 1], each for something.
class Random {
 public:
  explicit Random(std::uint64_t seed) : seed_(seed) {}
  [[nodiscard]] double operator()(std::uint64_t thing, std::uint64_t what) const {
    return uniform_minus_one_to_one(seed_, thing * 64 + what / 4, what % 4);
  }
  [[nodiscard]] Point3 vector(std::uint64_t thing, std::uint64_t what, double size) const {
    return {size * (*this)(thing, what), size * (*this)(thing, what + 1), size * (*this)(thing, what + 2)};
  }

 private:
  std::uint64_t seed_;
};

Point3 unit(Point3 v) {
  const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  for (double& x : v) x /= length;
  return v;
}

std::array<std::int64_t, 3> in_quanta(const Point3& x) {
  std::array<std::int64_t, 3> out;
  for (std::size_t a = 0; a < 3; ++a) out[a] = static_cast<std::int64_t>(x[a] / quantum);
  return out;
}

/// About the z axis, then about x.
std::array<Point3, 3> turned_by(double a, double b) {
  const double c = std::cos(a), s = std::sin(a), d = std::cos(b), e = std::sin(b);
  return {{{c, -s, 0}, {d * s, d * c, -e}, {e * s, e * c, d}}};
}

/// Walls at one time or, when they have moved, another.
WallsNow walls_at(const Random& random, const TriangleSurface& surface, int planes, double way) {
  WallsNow out;
  for (int w = 0; w < planes; ++w) {
    const auto k = static_cast<std::uint64_t>(100 + w);
    Point3 at = random.vector(k, 4, 3);
    const Point3 moved = random.vector(k, 8, way);
    for (std::size_t a = 0; a < 3; ++a) at[a] += moved[a];
    out.planes.push_back({in_quanta(at), unit(random.vector(k, 0, 1)), {}, 0, random(k, 12) < 0.8});
  }
  MeshNow mesh{};
  mesh.surface = &surface;
  mesh.centre = in_quanta(random.vector(200, 0, 1));
  mesh.way = random.vector(200, 4, way);
  mesh.rotation = turned_by(3 * random(200, 8) + 0.3 * way, 3 * random(200, 9));
  mesh.listed = random(200, 10) < 0.8;
  out.meshes.push_back(mesh);
  return out;
}

/// What of the skin the ways of a grain and a wall, which was not near, have used up [m].
double used(double gap_then, double gap, double skin) {
  return gap_then < skin ? -std::numeric_limits<double>::infinity() : skin - gap;
}

RC_GTEST_PROP(WallWays, are_bounds_of_all_grains_and_walls, ()) {
  const Random random(*rc::gen::arbitrary<std::uint64_t>());
  const auto rows = static_cast<std::size_t>(*rc::gen::inRange(1, 40));
  const int planes = *rc::gen::inRange(0, 5);
  const double skin = 0.3, way = *rc::gen::element(0.0, 0.1, 0.6), wall_way = *rc::gen::element(0.0, 0.2);
  std::vector<Point3> corners;
  for (std::uint64_t k = 0; k < 6; ++k) corners.push_back(random.vector(300 + k, 0, 2));
  const std::vector<TriangleSurface::Triangle> triangles{{0, 1, 2}, {2, 3, 4}, {1, 4, 5}};
  const TriangleSurface surface(corners, triangles);

  Particles p(3, {Field::position, Field::radius, Field::group});
  p.table().resize(rows, 0);
  std::vector<std::array<std::int64_t, 3>> then(rows);
  for (std::size_t i = 0; i < rows; ++i) {
    then[i] = in_quanta(random.vector(i, 0, 3));
    std::copy_n(then[i].begin(), 3, p.data<Field::position>() + i * 3);
    p.data<Field::radius>()[i] = 0.5 + 0.4 * random(i, 8);
  }
  WaysApart ways;
  ways.begin(p, static_cast<std::int64_t>(2.2 / quantum));
  const WallsNow before = walls_at(random, surface, planes, 0),
                 now = walls_at(random, surface, planes, wall_way);
  WallWays of_walls;
  of_walls.begin(before, ways, skin, quantum);
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t a = 0; a < 3; ++a)
      p.data<Field::position>()[i * 3 + a] += in_quanta(random.vector(i, 4, way))[a];

  double most = 0, most_of_planes = 0;
  for (std::size_t i = 0; i < rows; ++i) {
    const std::int64_t* x = p.data<Field::position>() + i * 3;
    const double radius = p.data<Field::radius>()[i];
    for (std::size_t w = 0; w < now.planes.size(); ++w) {
      if (!before.planes[w].present) continue;
      most_of_planes =
          std::max(most_of_planes, used(distance_from(before.planes[w], then[i].data(), quantum) - radius,
                                        distance_from(now.planes[w], x, quantum) - radius, skin));
    }
    const auto gap = [&](const MeshNow& mesh, const std::int64_t* at, std::size_t facet) {
      return std::sqrt(surface.nearest(facet, mesh.in_frame(at, quantum)).square) - radius;
    };
    for (std::size_t f = 0; f < surface.size() && before.meshes[0].listed; ++f)
      most = std::max(most, used(gap(before.meshes[0], then[i].data(), f), gap(now.meshes[0], x, f), skin));
  }
  most = std::max(most, most_of_planes);
  const double found = of_walls.look(p, ways, now), slack = 1e-6;
  RC_ASSERT(found >= most);
  WallsNow no_mesh = now;
  no_mesh.meshes.clear();
  const double found_of_planes = of_walls.look(p, ways, no_mesh);
  RC_ASSERT(found_of_planes >= most_of_planes);
  RC_ASSERT(found_of_planes <= most_of_planes + slack);
}

const std::string scene = R"(
dimension = 3
[domain]
lower = [-0.004, -0.004, -0.004]
upper = [0.03, 0.012, 0.03]
gravity = [0, 0, -9.81]
[contact]
law = "linear"
largest_overlap = 0.4
[[group]]
name = "sand"
kind = "grain"
density = 2500
diameter = [0.0008, 0.001]
normal_stiffness = 1000
restitution = 0.5
friction = 0.4
[start]
spacing = 0.0011
[time]
dt = 5e-6
steps = 1
[decomposition]
balance = "chaos"
)";
const std::string floor_and_paddle = R"(
[[wall]]
name = "floor"
material = "sand"
point = [0, 0, 0]
normal = [0, 0, 1]
[[wall]]
name = "paddle"
material = "sand"
point = [-0.001, 0, 0]
normal = [1, 0, 0.1]
velocity = [2, 0, 0]
)";
const std::string resting = R"(
[[wall]]
name = "floor"
material = "sand"
point = [0, 0, 0]
normal = [0, 0, 1]
)";
const std::string drum = R"(
[[mesh]]
name = "drum"
material = "sand"
file = ")" PEPERITE_TEST_DIR R"(/scenes/drum.obj"
scale = 0.008
origin = [0.006, 0.004, 0.006]
centre = [0.006, 0.004, 0.006]
axis = [0, 1, 0]
spin = 100
)";

/// A lattice of grains that are thrown in two pieces, with a gap between them.
std::vector<test::StartGrain> two_pieces(const Double3& first, const Double3& second, double gap) {
  std::vector<test::StartGrain> out;
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 6; ++j)
      for (int k = 0; k < 6; ++k) {
        const bool left = i < 4;
        out.push_back({"sand",
                       {0.001 + 0.0011 * i + (left ? 0 : gap), 0.001 + 0.0011 * j, 0.003 + 0.0011 * k},
                       left ? first : second,
                       {},
                       0.0004 + 0.0001 * ((i + j + k) % 2)});
      }
  return out;
}

struct Counts {
  std::int64_t rebuilds, rebuilds_by_bound;
};
/// The bits of a run on all ranks are those of lists made in every step; how often they were made, and would have been where
/// any two may have gone apart by what the fastest has gone.
Counts compare(const std::string& walls, const std::vector<test::StartGrain>& grains, const char* skin,
               int steps) {
  const decomp::Comm comm(MPI_COMM_WORLD), self(MPI_COMM_SELF);
  const test::StartFile file(comm, grains);
  std::vector<std::string> more{"start.file=" + file.path(), std::string("decomposition.skin=") + skin};
  Simulation s(comm, parse_scene(scene + walls, "pieces", more));
  more.emplace_back("decomposition.rebuild_every=1");
  Simulation often(self, parse_scene(scene + walls, "pieces", more));
  double way = 0;
  std::int64_t by_bound = 0;
  for (int k = 0; k < steps; ++k) {
    s.step(), often.step();
    EXPECT_EQ(s.fingerprint(), often.fingerprint()) << "step " << k + 1 << ", skin " << skin;
    way += s.global().max_speed * s.global().dt;
    if (2 * way > s.distribution().skin()) ++by_bound, way = 0;
  }
  return {s.rebuilds(), by_bound};
}

TEST(WallWays, grains_that_fall_together_are_listed_when_they_are_to_land) {
  for (const char* skin : {"0.05", "0.2", "0.5"}) {
    const auto grains = two_pieces({0, 0, -1.5}, {0, 0, -1.5}, 0);
    const Counts fall = compare(resting, grains, skin, 180),
                 all = compare(floor_and_paddle, grains, skin, 500);
    EXPECT_LT(2 * fall.rebuilds, fall.rebuilds_by_bound) << skin;
    EXPECT_LT(all.rebuilds, 500);
  }
}

TEST(WallWays, pieces_that_meet_are_listed_in_time) {
  for (const char* skin : {"0.05", "0.3"})
    for (const double gap : {0.0003, 0.001, 0.0016, 0.003})
      compare(floor_and_paddle, two_pieces({3, 0, 0}, {-3, 0.5, 0}, gap), skin, 150);
}

TEST(WallWays, grains_that_fall_together_in_a_drum_that_turns) {
  for (const char* skin : {"0.1", "0.3"})
    compare(drum, two_pieces({0.3, 0, -1.5}, {0.3, 0, -1.5}, 0), skin, 400);
}

// A way of 0.6 quanta is a whole one; both go it, and a skin of 1000 quanta is used up before 834 steps of it.
TEST(WallWays, roundings_of_ways_count) {
  const std::string wall = R"(
[[wall]]
name = "floor"
material = "sand"
point = [0, 0, 1e-3]
normal = [0, 0, 1]
velocity = [0, 0, 1.0408340855860841e-13]
)";
  const decomp::Comm comm(MPI_COMM_WORLD), self(MPI_COMM_SELF);
  const test::StartFile file(
      comm, {{"sand", {0.003, 0.003, 0.0015000000000017356}, {0, 0, -1.0408340855860841e-13}, {}, 0.0005}});
  std::vector<std::string> more{"start.file=" + file.path(), "domain.gravity=[0,0,0]",
                                "group.sand.diameter=1e-3", "time.dt=1e-5",
                                "decomposition.skin=1.734723475976807e-12"};
  Simulation s(self, parse_scene(scene + wall, "slow", more));
  more.emplace_back("decomposition.rebuild_every=1");
  Simulation often(self, parse_scene(scene + wall, "slow", more));
  for (int k = 0; k < 700; ++k) s.step(), often.step();
  EXPECT_EQ(s.fingerprint(), often.fingerprint());
  EXPECT_GT(often.grains()->pairs().counters().created, 0);
}

}  // namespace
}  // namespace sph
