// Is there a free surface at the start? Found by rows of the lattice, here beside a look at each of its points.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "region_texts.hpp"
#include "scene/lattice.hpp"
#include "scene/painting.hpp"
#include "scene/record.hpp"
#include "state_fixture.hpp"

namespace sph::test {
namespace {

Scene scene_of(const std::string& domain, const std::string& start) {
  return parse_scene(domain + R"(
[decomposition]
skin = 0
[kernel]
h_over_dx = 1
[[group]]
name = "water"
kind = "fluid"
density = 1000
sound_speed = 20
[[group]]
name = "wall"
kind = "wall"
[time]
until = 1
[start]
)" + start,
                     "surface.toml", {});
}

/// A place that is painted with nothing, or one of matter with no place beyond it along an axis whose period is not filled.
bool found_point_by_point(const Scene& scene) {
  const Lattice lattice(scene);
  const auto dim = static_cast<std::size_t>(scene.dim);
  std::vector<std::pair<Double3, int>> points;
  decomp::Int3 count{lattice.count(0), lattice.count(1), dim == 3 ? lattice.count(2) : 1}, k{};
  for (k[2] = 0; k[2] < count[2]; ++k[2])
    for (k[1] = 0; k[1] < count[1]; ++k[1])
      for (k[0] = 0; k[0] < count[0]; ++k[0]) {
        const Double3 x =
            lattice.point({k[0] + lattice.first(0), k[1] + lattice.first(1), k[2] + lattice.first(2)});
        if (lattice.inside(x)) points.emplace_back(x, painted_group(scene, x));
      }
  const LatticeFill& fill = scene.start.lattice;
  const auto repeats = [&](std::size_t a) {
    return scene.domain.periodic[a] && fill.lower[a] == scene.domain.lower[a] &&
           fill.upper[a] == scene.domain.upper[a];
  };
  const auto same_row = [&](const Double3& x, const Double3& y, std::size_t axis) {
    return axis != 0 || (std::abs(x[1] - y[1]) < 1e-9 && std::abs(x[2] - y[2]) < 1e-9);
  };
  return std::ranges::any_of(points, [&](const auto& point) {
    if (point.second < 0) return true;
    if (scene.groups[static_cast<std::size_t>(point.second)].kind == GroupKind::wall) return false;
    for (std::size_t a = 0; a < dim; ++a)
      for (const double side : {-1.0, 1.0})
        if (!repeats(a) && std::ranges::none_of(points, [&](const auto& other) {
              return side * (other.first[a] - point.first[a]) > 1e-9 && same_row(other.first, point.first, a);
            }))
          return true;
    return false;
  });
}

void expect(bool wanted, const std::string& domain, const std::string& start) {
  SCOPED_TRACE(domain + start);
  const Scene scene = scene_of(domain, start);
  EXPECT_EQ(scene.start.has_surface, wanted);
  if (scene.start.spacing > 0.04) {
    EXPECT_EQ(found_point_by_point(scene), wanted);
  }
}

const std::string square = "dimension = 2\n[domain]\nlower = [0, 0]\nupper = [1, 1]\n";
const std::string cube = "dimension = 3\n[domain]\nlower = [0, 0, 0]\nupper = [1, 0.8, 0.6]\n";
const std::string round_cube = cube + "periodic = [true, true, true]\n";
const std::string polygon =
    "shape = \"polygon\"\npoints = [[0.2, 0.2], [0.8, 0.3], [0.7, 0.8], [0.6, 0.4], [0.3, 0.75]]\n";
const std::string ring = "shape = \"mesh\"\nfile = \"" PEPERITE_TEST_DIR
                         "/scenes/ring.obj\"\norigin = [0.5, 0.4, 0.3]\nscale = 0.25\n";

TEST(FreeSurface, OfTanksInThePlane) {
  for (const char* lattice : {"square", "hexagonal"}) {
    const std::string dx = std::string("spacing = 0.05\nlattice = \"") + lattice + "\"\n",
                      closed = dx + region("wall", "") + region("water", box("[0.15, 0.15]", "[0.85, 0.85]"));
    expect(false, square, closed);
    expect(true, square, dx + region("water", ""));
    expect(true, square, closed + region("water", box("[0.3, 0.8]", "[0.4, 1]")));
    expect(true, square, closed + region("water", box("[0.8, 0.3]", "[1, 0.4]")));
    expect(true, square, closed + region("none", ball("[0.52, 0.52]", 0.05)));
    expect(true, square, closed + region("none", polygon));
    expect(false, square, closed + region("none", polygon) + region("wall", box("[0.1, 0.1]", "[0.9, 0.9]")));
    // A hole that is filled by what itself has bays.
    expect(true, square, closed + region("none", box("[0.1, 0.1]", "[0.9, 0.9]")) + region("water", polygon));
    expect(false, square,
           closed + region("none", box("[0.42, 0.4]", "[0.58, 0.5]")) + region("water", polygon) +
               region("wall", box("[0.4, 0.4]", "[0.6, 0.6]")));
  }
}

TEST(FreeSurface, InThreeDimensions) {
  const std::string dx = "spacing = 0.05\n", water = dx + region("water", "");
  expect(false, round_cube, water);
  expect(true, cube, water);
  expect(true, round_cube, "upper = [1, 0.8, 0.5]\n" + water);
  expect(true, round_cube, water + region("none", ball("[0.525, 0.425, 0.325]", 0.02)));
  expect(true, round_cube, water + region("none", ring));
  expect(false, round_cube, water + region("wall", ring));
  const std::string tank = cube + "periodic = [false, true, false]\n",
                    closed =
                        dx + region("wall", "") + region("water", box("[0.2, 0, 0.2]", "[0.8, 0.8, 0.45]"));
  expect(false, tank, closed);
  expect(true, tank, closed + region("water", box("[0.4, 0.4, 0.4]", "[0.45, 0.45, 0.6]")));
  expect(true, tank, closed + region("water", box("[0, 0.4, 0.3]", "[0.3, 0.45, 0.35]")));
  expect(true, cube, closed);
  // One place in a million, at each of some.
  const std::string fine =
      "dimension = 3\n[domain]\nlower = [0, 0, 0]\nupper = [1, 1, 1]\nperiodic = [true, true, true]\n";
  for (const double at : {0.005, 0.015, 0.305, 0.495, 0.725, 0.995}) {
    const std::string x = std::to_string(at), y = std::to_string(1 - at);
    expect(true, fine,
           "spacing = 0.01\n" + region("water", "") +
               region("none", ball("[" + x + ", " + y + ", " + x + "]", 0.004)));
  }
}

// A run's record is read without its meshes: it is refused for no surface that only they fill.
TEST(FreeSurface, OfARecordIsNotAsked) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("peperite_cube_" + std::to_string(getpid()) + ".obj");
  std::ofstream(file)
      << "v -1 -1 -1\nv 2 -1 -1\nv 2 2 -1\nv -1 2 -1\nv -1 -1 2\nv 2 -1 2\nv 2 2 2\nv -1 2 2\n"
         "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\nf 4 1 5 8\n";
  const Scene scene =
      scene_of(round_cube + "gravity = [0, 0, -1]\nbackground_density = 500\n",
               "spacing = 0.05\n" + region("water", "shape = \"mesh\"\nfile = \"" + file.string() + "\"\n"));
  EXPECT_FALSE(scene.start.has_surface);
  EXPECT_NO_THROW((void)parse_record(to_toml(scene), "record.toml"));
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace sph::test
