// Nearest points of triangles against points spread over them; which triangles are near, against asking all.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include "files/mesh_file.hpp"
#include "sph/core/error.hpp"
#include "sph/pairs/triangle_surface.hpp"

namespace {

using sph::Point3, sph::NearPoint, sph::TriangleSurface;
using Corners = std::vector<TriangleSurface::Triangle>;

class Random {
 public:
  double number(double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(engine_);
  }
  Point3 point(double size) { return {number(-size, size), number(-size, size), number(-size, size)}; }

 private:
  std::mt19937_64 engine_{7};
};

double square(const Point3& a, const Point3& b) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sum;
}

TEST(TriangleSurface, NearestPointsAreTheNearest) {
  Random random;
  for (int n = 0; n < 2000; ++n) {
    const std::vector<Point3> v{random.point(1), random.point(1), random.point(random.number(0.1, 3))};
    const TriangleSurface one(v, Corners{{0, 1, 2}});
    const Point3 x = random.point(2);
    const NearPoint near = one.nearest(0, x);
    EXPECT_NEAR(square(x, near.point), near.square, 1e-12);
    double best = 1e300;
    constexpr int parts = 60;
    for (int i = 0; i <= parts; ++i)
      for (int j = 0; i + j <= parts; ++j) {
        const double a = double(i) / parts, b = double(j) / parts;
        Point3 at;
        for (std::size_t k = 0; k < 3; ++k) at[k] = (1 - a - b) * v[0][k] + a * v[1][k] + b * v[2][k];
        best = std::min(best, square(x, at));
        // It is one of the triangle: of a convex set the nearest point sees all others behind it.
        double ahead = 0;
        for (std::size_t k = 0; k < 3; ++k) ahead += (x[k] - near.point[k]) * (at[k] - near.point[k]);
        EXPECT_LE(ahead, 1e-9);
      }
    EXPECT_LE(near.square, best + 1e-12);
    EXPECT_GE(std::sqrt(near.square), std::sqrt(best) - 0.08);
  }
}

TEST(TriangleSurface, BothSidesOfAnEdgeFindTheSamePoint) {
  Random random;
  int on_the_edge = 0;
  for (int n = 0; n < 5000; ++n) {
    const std::vector<Point3> v{random.point(1), random.point(1), random.point(1), random.point(1)};
    const TriangleSurface two(v, Corners{{0, 1, 2}, {1, 0, 3}});
    const Point3 x = random.point(1.5);
    const NearPoint a = two.nearest(0, x), b = two.nearest(1, x);
    if (a.of != b.of || a.of.is_face()) continue;
    ++on_the_edge;
    EXPECT_EQ(a.square, b.square);
    EXPECT_EQ(a.point, b.point);
    EXPECT_TRUE(two.has(0, a.of) && two.has(1, a.of) && two.share_vertex(0, 1));
  }
  EXPECT_GT(on_the_edge, 500);
}

TEST(TriangleSurface, FindsWhatIsNear) {
  Random random;
  for (const bool flat : {false, true}) {
    std::vector<Point3> vertices;
    Corners triangles;
    for (std::uint32_t n = 0; n < 300; ++n) {
      const double size = n == 0 ? 5 : random.number(0.01, 0.5);  // one beside which all others are small
      const Point3 centre = random.point(2);
      for (int corner = 0; corner < 3; ++corner) {
        Point3 p = random.point(size);
        for (std::size_t k = 0; k < 3; ++k) p[k] += centre[k];
        if (flat) p[2] = 0.25;
        vertices.push_back(p);
      }
      triangles.push_back({3 * n, 3 * n + 1, 3 * n + 2});
    }
    const TriangleSurface surface(vertices, triangles), same(surface.block());
    std::vector<std::uint32_t> found;
    std::size_t all = 0;
    for (int n = 0; n < 2000; ++n) {
      const Point3 x = random.point(4);
      const double reach = random.number(0.01, 0.8);
      std::vector<std::uint32_t> wanted;
      for (std::uint32_t t = 0; t < surface.size(); ++t)
        if (surface.nearest(t, x).square < reach * reach) wanted.push_back(t);
      surface.find(x, reach, found);
      EXPECT_EQ(found, wanted);
      same.find(x, reach, found);
      EXPECT_EQ(found, wanted);
      all += found.size();
    }
    EXPECT_GT(all, 500U);
  }
}

// Slender triangles that lie askew meet the more cells the more there are: cells become wider.
TEST(TriangleSurface, TakesLittleMemory) {
  Random random;
  std::vector<Point3> vertices;
  Corners triangles;
  for (std::uint32_t n = 0; n < 2000; ++n) {
    for (const Point3& shift : {Point3{0, 0, 0}, Point3{1, 1, 1}, Point3{1, 1, 1.001}}) {
      Point3 p = shift;
      for (double& c : p) c += random.number(-1e-4, 1e-4);
      vertices.push_back(p);
    }
    triangles.push_back({3 * n, 3 * n + 1, 3 * n + 2});
  }
  const TriangleSurface surface(vertices, triangles);
  EXPECT_LT(surface.bytes(), 2000 * (3 * 24 + 12 + 16 * 4 + 4) + 1000);
  std::vector<std::uint32_t> found;
  surface.find({0.5, 0.5, 0.5}, 0.01, found);
  EXPECT_EQ(found.size(), 2000U);
}

/// What reading a file with this text says.
std::string said_of(const std::string& text, const std::string& ending) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("peperite_mesh_" + std::to_string(getpid()) + ending);
  std::ofstream(file) << text;
  std::string said;
  try {
    const sph::Triangles read = sph::read_triangles(file.string(), "mesh.one");
    said = std::to_string(read.vertices.size()) + " vertices, " + std::to_string(read.corners.size());
  } catch (const sph::InputError& error) {
    said = error.what();
  }
  std::filesystem::remove(file);
  return said;
}

std::string facet(const std::string& a, const std::string& b, const std::string& c) {
  return "facet normal 0 0 1\n outer loop\n vertex " + a + "\n vertex " + b + "\n vertex " + c +
         "\n endloop\nendfacet\n";
}

TEST(MeshFile, SaysWhichFacetIsBroken) {
  const std::string good = facet("0 0 0", "1 0 0", "0 1 0"), beside = facet("1 0 0", "1 1 0", "0 1 0");
  const auto stl = [](const std::string& facets) {
    return said_of("solid x\n" + facets + "endsolid x\n", ".stl");
  };
  EXPECT_EQ(stl(good + beside), "4 vertices, 2");
  EXPECT_EQ(stl(good + facet("0 0 0", "-0 -0 1", "1 0 0")), "4 vertices, 2");
  EXPECT_EQ(stl(good + facet("0 0 0", "1 1 1", "2 2 2")), "mesh.one: facet 2 has no area; repair the mesh");
  EXPECT_EQ(stl(good + beside + facet("0 0 0", "0 0 0", "2 2 2")),
            "mesh.one: facet 3 has no area; repair the mesh");
  EXPECT_NE(stl("").find("mesh.one"), std::string::npos);
  const auto polygon = [](const std::string& corners) {
    return "facet normal 0 0 1\n outer loop\n" + corners + " endloop\nendfacet\n";
  };
  const std::string square = polygon(" vertex 0 0 0\n vertex 1 0 0\n vertex 1 1 0\n vertex 0 1 0\n");
  EXPECT_EQ(stl(good + square + beside), "mesh.one: facet 2 has 4 corners; make triangles of it");
  EXPECT_EQ(said_of("solid facet of a vertex\n" + good + "endsolid facet\n", ".stl"), "3 vertices, 1");
  std::string of_returns = "solid x\n" + good + square + "endsolid x\n";
  std::ranges::replace(of_returns, '\n', '\r');
  EXPECT_EQ(said_of(of_returns, ".stl"), "mesh.one: facet 2 has 4 corners; make triangles of it");
  EXPECT_EQ(
      said_of("solid x\n" + good + "endsolid x\n# the next facet\nsolid y\n" + beside + "endsolid", ".stl"),
      "mesh.one: 1 of 2 facets can be read; begin each solid with a line \"solid NAME\"");
  EXPECT_EQ(said_of("solid x\n" + good + "endsolid x\nSolid y\n" + beside + "endsolid y\n", ".stl"),
            "mesh.one: 1 of 2 facets can be read; begin each solid with a line \"solid NAME\"");
  EXPECT_EQ(said_of("solid x\n" + good + "endsolid x\nsolid y\n" + beside + "endsolid y\n", ".stl"),
            "4 vertices, 2");
  // Of three facets of two corners the importer makes two of three.
  EXPECT_EQ(stl(good + polygon(" vertex 0 0 0\n vertex 1 0 0\n") + polygon(" vertex 1 1 0\n vertex 0 1 0\n") +
                polygon(" vertex 2 1 0\n vertex 0 2 0\n"))
                .find("mesh.one: "),
            0U);
  EXPECT_NE(said_of("not a mesh at all", ".stl").find("give an STL or OBJ file"), std::string::npos);
  EXPECT_NE(said_of("", ".obj").find("give an STL or OBJ file"), std::string::npos);
  EXPECT_EQ(said_of("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n", ".obj"), "4 vertices, 2");
  EXPECT_NE(said_of("v 0 0 0\nv 1 0 0\nl 1 2\n", ".obj").find("mesh.one"), std::string::npos);
  EXPECT_EQ(said_of("v 0 0 0\nv 1 x 0\nv 1 1 0\nv 0 1 0\nf 1 3 4\n", ".obj"),
            "mesh.one: line 2 is of a vertex and has no three numbers; repair the mesh");
  EXPECT_EQ(said_of("v 0 0 0\n \tv 1 x 0\nv 1 1 0\nv 0 1 0\nv 1 0 0\nf 1 3 4\n", ".obj"),
            "mesh.one: line 2 is of a vertex and has no three numbers; repair the mesh");
  // Cut off anywhere, in a number of the second facet too.
  const std::string whole = "solid x\n" + good + beside;
  for (std::size_t end = 9; end < whole.size(); ++end)
    EXPECT_EQ(said_of(whole.substr(0, end), ".stl").find("mesh.one: "), 0U) << end;
  EXPECT_EQ(said_of(whole + "EndSolid \r\n\n", ".stl"), "4 vertices, 2");
  EXPECT_NE(
      said_of(
          "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
          "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 "
          "2\n",
          ".ply")
          .find("another format"),
      std::string::npos);
}

// What an OBJ says of materials is not opened: a pipe would never end.
TEST(MeshFile, ReadsTheMeshAlone) {
  const std::filesystem::path pipe =
      std::filesystem::temp_directory_path() / ("peperite_pipe_" + std::to_string(getpid()));
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(said_of("mtllib " + pipe.filename().string() + "\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n", ".obj"),
            "3 vertices, 1");
  std::filesystem::remove(pipe);
}

}  // namespace
