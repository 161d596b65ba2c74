// Regions of the start that are polygons and meshes: what is inside, to the last place on an edge.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "scene/mesh_volume.hpp"
#include "scene/painting.hpp"
#include "sph/scene/scene.hpp"
#include "state_fixture.hpp"

namespace sph {
namespace {

Region polygon(std::vector<std::array<double, 2>> points) {
  Region r;
  r.shape = RegionShape::polygon;
  r.points = std::move(points);
  return r;
}

/// Places of a lattice in [0, n)^d that a region contains.
template <class Visit>
int count(const Region& r, int n, int dim, double dx, Visit&& visit) {
  int inside = 0;
  for (int k = 0; k < (dim == 3 ? n : 1); ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const Double3 x{i * dx, j * dx, k * dx};
        const bool in = contains(r, x, static_cast<std::size_t>(dim));
        visit(x, in);
        inside += in ? 1 : 0;
      }
  return inside;
}

/// Two triangles for each face of a box; `left_out` of them are missing.
MeshVolume cuboid(const Double3& lower, const Double3& upper, std::size_t left_out = 0) {
  std::vector<Double3> v;
  for (int k = 0; k < 8; ++k)
    v.push_back({((k & 1) != 0 ? upper : lower)[0], ((k & 2) != 0 ? upper : lower)[1],
                 ((k & 4) != 0 ? upper : lower)[2]});
  std::vector<MeshVolume::Corners> t{{0, 1, 3}, {0, 3, 2}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                     {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 3, 7}, {1, 7, 5}};
  t.erase(t.begin(), t.begin() + static_cast<std::ptrdiff_t>(left_out));
  return {v, t};
}

Region box(const Double3& lower, const Double3& upper) {
  Region r;
  r.shape = RegionShape::box;
  r.lower = lower;
  r.upper = upper;
  return r;
}
Region mesh(MeshVolume volume) {
  Region r;
  r.shape = RegionShape::mesh;
  r.mesh.volume = std::make_shared<const MeshVolume>(std::move(volume));
  return r;
}

// Edges through places of the lattice: each belongs to what a box would have it belong to.
TEST(Regions, PolygonsOfRightAnglesAreBoxes) {
  const Region a = polygon({{0.25, 0.5}, {2, 0.5}, {2, 3.25}, {0.25, 3.25}}), b = box({0.25, 0.5}, {2, 3.25});
  count(a, 20, 2, 0.25,
        [&](const Double3& x, bool in) { EXPECT_EQ(in, contains(b, x, 2)) << x[0] << " " << x[1]; });
}

// What shares an edge shares no place and leaves none between.
TEST(Regions, PolygonsBesideEachOtherHaveNoSeam) {
  const std::array<double, 2> a{0.3, 0.2}, b{4.1, 0.7}, c{3.3, 4.2}, d{0.9, 3.7}, m{2.25, 1.75};
  const std::vector<Region> parts{polygon({a, b, m}), polygon({m, b, c}), polygon({d, m, c}),
                                  polygon({a, m, d})};
  const Region whole = polygon({a, b, c, d});
  const int inside = count(whole, 80, 2, 0.0625, [&](const Double3& x, bool in) {
    int times = 0;
    for (const Region& r : parts) times += contains(r, x, 2) ? 1 : 0;
    EXPECT_EQ(times, in ? 1 : 0) << x[0] << " " << x[1];
  });
  EXPECT_NEAR(inside / 256.0, 10.9, 0.06);  // by Gauss's formula
}

TEST(Regions, PolygonsThatCrossThemselvesAreEvenOdd) {
  const Region bow = polygon({{0, 0}, {4, 4}, {4, 0}, {0, 4}});
  EXPECT_TRUE(contains(bow, {0.5, 2, 0}, 2));
  EXPECT_FALSE(contains(bow, {2, 0.5, 0}, 2));
}

TEST(Regions, MeshesOfBoxesAreBoxes) {
  const Double3 lower{0.25, 0.5, 1}, upper{2, 3.25, 2.25};
  for (std::size_t left_out : {0, 1, 2}) {  // of the floor: one of three rays goes through it
    const Region a = mesh(cuboid(lower, upper, left_out)), b = box(lower, upper);
    count(a, 16, 3, 0.25, [&](const Double3& x, bool in) {
      EXPECT_EQ(in, contains(b, x, 3)) << x[0] << " " << x[1] << " " << x[2] << ", without " << left_out;
    });
  }
}

TEST(Regions, OpenEdgesAreThoseOfOneTriangle) {
  const Double3 lower{0, 0, 0}, upper{1, 1, 1};
  EXPECT_EQ(cuboid(lower, upper).open_edges(), 0U);
  EXPECT_EQ(cuboid(lower, upper, 1).open_edges(), 3U);
  EXPECT_EQ(cuboid(lower, upper, 2).open_edges(), 4U);
}

std::string ring_scene(const std::string& more) {
  return R"(
dimension = 3
[domain]
lower = [-2, -2, -1]
upper = [2, 2, 1]
[kernel]
h_over_dx = 1.2
[[group]]
name = "water"
kind = "fluid"
density = 1000
sound_speed = 20
[time]
until = 1
[start]
spacing = 0.1
[[start.region]]
group = "water"
shape = "mesh"
file = ")" PEPERITE_TEST_DIR "/scenes/ring.obj\"\n" +
         more;
}

TEST(Regions, MeshesHaveHoles) {
  const Scene s = parse_scene(ring_scene(""), "ring.toml", {});
  const Region& r = s.start.lattice.regions.at(0);
  EXPECT_FALSE(contains(r, {0, 0, 0}, 3));
  EXPECT_FALSE(contains(r, {0.3, -0.3, 0}, 3));
  EXPECT_TRUE(contains(r, {0, 1, 0}, 3));
  EXPECT_TRUE(contains(r, {-0.9, 0.1, 0.2}, 3));
  int inside = 0;
  const int n = 120;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        inside += contains(r, {-1.5 + 3.0 * i / n, -1.5 + 3.0 * j / n, -1.5 + 3.0 * k / n}, 3) ? 1 : 0;
  // Of 24 sides around and 12 about: the area of a regular polygon is n sin(2 pi/n)/2, a step around a chord wide.
  const double pi = std::numbers::pi, round = 24 * std::sin(2 * pi / 24),
               about = 6 * std::sin(2 * pi / 12) * 0.16;
  EXPECT_NEAR(inside * std::pow(3.0 / n, 3), round * about, 0.02 * round * about);
}

TEST(Regions, AreWrittenAsTheyWereRead) {
  const Scene s = parse_scene(ring_scene("scale = 0.5\norigin = [0.1, 0, 0]\n"), "ring.toml", {});
  EXPECT_EQ(parse_scene(to_toml(s), "ring.toml", {}), s);
  const Scene again = parse_scene(to_toml(s), "elsewhere/ring.toml", {});
  EXPECT_EQ(again.start.lattice.regions.at(0).mesh.file, s.start.lattice.regions.at(0).mesh.file);
  EXPECT_EQ(s.start.lattice.regions.at(0).mesh.content.size(), 16U);
}

// A run goes on with the file that it began with.
TEST(Regions, AreOfTheFileThatTheRunBeganWith) {
  const decomp::Comm alone(MPI_COMM_SELF);
  const test::ScratchDirectory scratch(alone);
  const std::string file = (scratch.path() / "one.obj").string();
  const auto write = [&](const char* last) {
    std::ofstream(file) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                        << last << "f 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n";
  };
  std::string text = ring_scene("");
  const std::string name = PEPERITE_TEST_DIR "/scenes/ring.obj";
  text.replace(text.find(name), name.size(), file);
  write("");
  const std::string resolved = to_toml(parse_scene(text, "one.toml", {}));
  EXPECT_NO_THROW((void)parse_scene(resolved, "one.toml", {}));
  write("v 9 9 9\n");
  try {
    (void)parse_scene(resolved, "one.toml", {});
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("is another than the run began with"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace sph
