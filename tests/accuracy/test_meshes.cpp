// Grains on walls of triangles: a floor of facets against a plane, a ball on a turntable (Ehrlich & Tuszynski 1995: it runs in
// circles at 2/7 of the table's rate), a ball that swings in a tube of facets, balls that bounce off edges and corners.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "accuracy/mesh_balls.hpp"
#include "accuracy/pinned.hpp"

namespace {

using namespace mesh_balls;

// Facets of all shapes in one plane that lies askew: a ball that hops and rolls over some forty of their edges sees none.
TEST(Meshes, FacetsInAPlaneAreThePlane) {
  const Files files;
  const Point n{2 / std::sqrt(30.0), -1 / std::sqrt(30.0), 5 / std::sqrt(30.0)};
  const Point u{5 / std::sqrt(29.0), 0, -2 / std::sqrt(29.0)};
  const Point w{n[1] * u[2] - n[2] * u[1], n[2] * u[0] - n[0] * u[2], n[0] * u[1] - n[1] * u[0]};
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> shift(-0.04, 0.04);
  Mesh mesh;
  mesh.sheet(40, 40, [&](int i, int j) {
    const double a = (i - 20) * 0.1 + shift(random), b = (j - 20) * 0.1 + shift(random);
    return Point{a * u[0] + b * w[0], a * u[1] + b * w[1], a * u[2] + b * w[2]};
  });
  const std::string file = files.add("floor.obj", mesh.text());
  const std::string text =
      steel + "friction = 0.5\nrestitution = 0.9\n" +
      start_of(files, {{{0.05 * u[0] + 0.12 * n[0], 0.12 * n[1], 0.05 * u[2] + 0.12 * n[2]},
                        {0.9, 0.7, 0.1},
                        {1, 2, 3}}}) +
      "[domain]\nlower = [-4, -4, -4]\nupper = [4, 4, 4]\ngravity = [-4, 2, -10]\n";
  const std::string time = "[time]\ndt = 2e-5\n";
  char plane[200];
  (void)std::snprintf(
      plane, sizeof plane,
      "[[wall]]\nname = \"floor\"\nmaterial = \"steel\"\npoint = [0, 0, 0]\nnormal = [%.17g, %.17g, %.17g]\n",
      n[0], n[1], n[2]);
  const Ball exact = run(text + plane + time, 1.5);
  const Ball faceted =
      run(text + "[[mesh]]\nname = \"floor\"\nmaterial = \"steel\"\nfile = \"" + file + "\"\n" + time, 1.5);
  for (std::size_t a = 0; a < 3; ++a) {
    EXPECT_NEAR(faceted.x[a], exact.x[a],
                1e-6);  // vertices are read in single precision: none is quite in the plane
    EXPECT_NEAR(faceted.v[a], exact.v[a], 1e-6);
    EXPECT_NEAR(faceted.w[a], exact.w[a], 1e-5);
  }
  EXPECT_GT(std::hypot(exact.x[0], exact.x[1]), 1);
}

// In a plane that single precision can hold it is the plane to the last bit.
TEST(Meshes, FacetsOfALevelFloorAreThePlaneToTheBit) {
  const Files files;
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> shift(-0.04, 0.04);
  Mesh mesh;
  mesh.sheet(40, 40, [&](int i, int j) {
    return Point{(i - 20) * 0.1 + shift(random), (j - 20) * 0.1 + shift(random), 0};
  });
  const std::string text = steel + "friction = 0.5\nrestitution = 0.9\n" +
                           start_of(files, {{{-1, -1, 0.12}, {1.5, 1.3, 0.1}, {1, 2, 3}}}) +
                           "[domain]\nlower = [-4, -4, -4]\nupper = [4, 4, 4]\ngravity = [0, 0, -10]\n";
  const std::string time = "[time]\ndt = 2e-5\n";
  const Ball exact =
      run(text + "[[wall]]\nname = \"floor\"\nmaterial = \"steel\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n" +
              time,
          1.5);
  const Ball faceted = run(text + "[[mesh]]\nname = \"floor\"\nmaterial = \"steel\"\nfile = \"" +
                               files.add("floor.obj", mesh.text()) + "\"\n" + time,
                           1.5);
  EXPECT_EQ(faceted.x, exact.x);
  EXPECT_EQ(faceted.v, exact.v);
  EXPECT_EQ(faceted.w, exact.w);
  EXPECT_GT(std::hypot(exact.x[0] + 1, exact.x[1] + 1), 1);
}

// Steady: d v/dt = 2/7 Omega x v, a circle wherever it is on the table. The table is turned by itself, its facets move on
// beneath the ball.
TEST(Meshes, BallOnATurntable) {
  const Files files;
  Mesh mesh;
  mesh.sheet(48, 12, [](int i, int j) {
    const double angle = 2 * std::numbers::pi * i / 48, r = 0.01 + 0.1 * j;
    return Point{r * std::cos(angle), r * std::sin(angle), 0};
  });
  constexpr double turn = 3, x = 0.5, v = 0.4, g = 10;
  constexpr double mass = 2500 * 4 * std::numbers::pi / 3 * 1e-3, deep = mass * g / 1e5;
  // Rolling: v + w x (-r n) = Omega x.
  const std::string text = steel + "friction = 1\nrestitution = 0.5\n" +
                           start_of(files, {{{x, 0, 0.1 - deep}, {0, v, 0}, {(turn * x - v) / 0.1, 0, 0}}}) +
                           "[domain]\nlower = [-2, -2, -1]\nupper = [2, 2, 1]\ngravity = [0, 0, "
                           "-10]\n[[mesh]]\nname = \"table\"\n" +
                           "material = \"steel\"\nfile = \"" + files.add("table.obj", mesh.text()) +
                           "\"\nspin = 3\n[time]\ndt = 1e-4\n";
  constexpr double rate = 2.0 / 7 * turn, radius = v / rate, until = 6;
  double worst = 0;
  run(text, until, [&](const sph::Simulation& s) {
    const double phase = rate * s.global().time;
    const Ball now = ball(s);
    worst = std::max(worst, std::hypot(now.x[0] - (x - radius + radius * std::cos(phase)),
                                       now.x[1] - radius * std::sin(phase)));
  });
  const double off = worst / radius;
  EXPECT_LT(PINNED(off), 0.01);
}

/// Period of a ball that rolls to and fro in a tube of so many facets, over that in a round one.
double swing(int facets) {
  const Files files;
  Mesh mesh;
  mesh.sheet(facets, 1, [&](int i, int j) {
    const double angle = 2 * std::numbers::pi * (i + 0.5) / facets;
    return Point{std::cos(angle), 2.0 * j - 1, std::sin(angle)};
  });
  constexpr double amplitude = 0.5, arm = 0.9;
  const std::string text =
      steel + "friction = 1\nrestitution = 0.5\n" +
      start_of(files, {{{arm * std::sin(amplitude), 0, -arm * std::cos(amplitude)}, {0, 0, 0}, {0, 0, 0}}}) +
      "[domain]\nlower = [-2, -2, -2]\nupper = [2, 2, 2]\ngravity = [0, 0, -10]\n[[mesh]]\nname = "
      "\"tube\"\n" +
      "material = \"steel\"\nfile = \"" + files.add("tube.obj", mesh.text()) + "\"\n[time]\ndt = 5e-5\n";
  std::vector<double> crossings;
  double before = 1, time = 0;
  run(text, 5, [&](const sph::Simulation& s) {
    const double x = ball(s).x[0];
    if ((x < 0) != (before < 0)) crossings.push_back(time - before * (s.global().time - time) / (x - before));
    before = x, time = s.global().time;
  });
  const double period =
      2 * (crossings.back() - crossings.front()) / static_cast<double>(crossings.size() - 1);
  return period / (2 * std::numbers::pi * std::sqrt(1.4 * arm / 10));
}

TEST(Meshes, BallInATube) {
  constexpr double exact = 1 + 0.5 * 0.5 / 16;  // to the second order of the amplitude
  const double coarse = swing(72), fine = swing(360);
  std::printf("tube: period %.4f of 72 facets, %.4f of 360\n", coarse, fine);
  EXPECT_NEAR(PINNED(coarse), exact, 0.01);
  EXPECT_NEAR(PINNED(fine), exact, 0.003);
}

// Without friction and losses: energy stays wherever faces, edges and corners, hollow and sharp, are hit.
TEST(Meshes, EnergyStaysAtEdgesAndCorners) {
  const Files files;
  Mesh mesh;
  const auto corner = [](int k) { return Point{k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k & 4 ? 1.0 : -1.0}; };
  for (int k = 0; k < 8; ++k) mesh.vertex(corner(k));
  for (const auto& q :
       {std::array{1, 2, 4, 3}, {5, 6, 8, 7}, {1, 2, 6, 5}, {3, 4, 8, 7}, {1, 3, 7, 5}, {2, 4, 8, 6}}) {
    mesh.facet(q[0], q[1], q[2]);
    mesh.facet(q[0], q[2], q[3]);
  }
  const int a = mesh.vertex({0.5, 0, 0}), b = mesh.vertex({-0.2, 0.4, -0.3}),
            c = mesh.vertex({-0.2, -0.4, -0.3}), d = mesh.vertex({-0.1, 0, 0.5});
  for (const auto& t : {std::array{a, b, c}, {a, b, d}, {a, c, d}, {b, c, d}}) mesh.facet(t[0], t[1], t[2]);
  const std::string text =
      "[contact]\nlaw = \"hertz\"\n[[group]]\nname = \"steel\"\nkind = \"grain\"\ndiameter = 0.2\ndensity = "
      "2500\nyoung_modulus = 1e7\npoisson_ratio = 0.3\nrestitution = 1\n" +
      start_of(files, {{{0.6, 0.55, 0.7}, {1.3, -0.9, 0.4}, {}}}) +
      "[domain]\nlower = [-2, -2, -2]\nupper = [2, 2, 2]\ngravity = [0, 0, -1]\n[[mesh]]\nname = \"room\"\n" +
      "material = \"steel\"\nfile = \"" + files.add("room.obj", mesh.text()) + "\"\n[time]\ndt = 2e-5\n";
  int bounces = 0;
  double worst = 0;
  bool touched = false;
  run(text, 15, [&](const sph::Simulation& s) {
    const bool touches = s.global().walls[0].force != std::array<std::int64_t, 3>{};
    bounces += touches && !touched ? 1 : 0;
    touched = touches;
    if (touches) return;
    const Ball now = ball(s);
    const double energy = 0.5 * (now.v[0] * now.v[0] + now.v[1] * now.v[1] + now.v[2] * now.v[2]) + now.x[2];
    constexpr double first = 0.5 * (1.3 * 1.3 + 0.9 * 0.9 + 0.4 * 0.4) + 0.7;
    worst = std::max(worst, std::abs(energy / first - 1));
  });
  EXPECT_GT(bounces, 15);
  EXPECT_LT(PINNED(worst), 1e-4);
}

}  // namespace
