// Meshes along a direction as grains let them: masses that rest, fall and are hit, servos that press.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "accuracy/mesh_balls.hpp"
#include "sph/core/error.hpp"

namespace {

using namespace mesh_balls;

/// A level plate.
std::string plate(const Files& files, double z) {
  Mesh mesh;
  mesh.sheet(3, 3, [&](int i, int j) { return Point{i - 1.5, j - 1.5, z}; });
  return "[[mesh]]\nname = \"plate\"\nmaterial = \"steel\"\nfile = \"" + files.add("plate.obj", mesh.text()) +
         "\"\n";
}

/// A ball that lies on a floor under a plate, and gravity along z.
std::string pressed(const Files& files, double gravity) {
  char text[400];
  (void)std::snprintf(text, sizeof text,
                      "[domain]\nlower = [-2, -2, -2]\nupper = [2, 2, 2]\ngravity = [0, 0, "
                      "%.17g]\n[[wall]]\nname = \"floor\"\n"
                      "material = \"steel\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n",
                      gravity);
  return steel + "friction = 0.5\nrestitution = 0.2\n" + start_of(files, {{{0, 0, 0.1}, {}, {}}}) + text +
         plate(files, 0.203);
}

double way_of_plate(const sph::Simulation& s) {
  return s.scale().metres(s.global().walls[1].offset[2]) - s.scale().metres(0);
}

// The springs of the ball's two contacts bear the plate, the lower one the ball too.
TEST(DrivenMeshes, MassesRestOnWhatBearsThem) {
  const Files files;
  constexpr double g = 10, mass = 40, ball_mass = 2500 * 4 * std::numbers::pi / 3 * 1e-3, k = 1e5;
  double way = 0, force = 0;
  const Ball end =
      run(pressed(files, -g) + "direction = [0, 0, -1]\nmass = 40\nlargest_speed = 5\n[time]\ndt = 2e-4\n", 3,
          [&](const sph::Simulation& s) {
            way = way_of_plate(s);
            force = s.grains()->walls().newton(s.global().walls[1].force[2]);
          });
  const double low = (mass + ball_mass) * g / k, high = mass * g / k;
  EXPECT_NEAR(force / (mass * g), 1, 1e-6);
  EXPECT_NEAR(0.1 - end.x[2], low, 1e-4 * low);
  EXPECT_NEAR(-way, 0.003 + low + high, 1e-4 * low);
}

TEST(DrivenMeshes, MassesFallUntilTheyAreAsFastAsTheyMayBe) {
  const Files files;
  const std::string text =
      pressed(files, -10) +
      "direction = [0, 1, 2]\nmass = 3\nforce = 90\nlargest_speed = 2\n[time]\ndt = 1e-4\n";
  double worst = 0;
  const double along = -10 * 2 / std::sqrt(5.0) + 30,
               free = 2 / along;  // of gravity along it, and the force's
  run(text, 0.3, [&](const sph::Simulation& s) {
    const double t = s.global().time;
    const double exact = t < free ? along * t * t / 2 : along * free * free / 2 + 2 * (t - free);
    worst = std::max(worst, std::abs(way_of_plate(s) - 2 / std::sqrt(5.0) * exact));
  });
  EXPECT_LT(worst, 3e-4);  // the first half step has no kick: along dt t / 2
}

TEST(DrivenMeshes, ServosPressAsTold) {
  const Files files;
  double force = 0;
  const Ball end = run(
      pressed(files, 0) +
          "direction = [0, 0, -1]\nforce = 300\nservo_gain = 1e-4\nlargest_speed = 0.1\n[time]\ndt = 2e-4\n",
      8, [&](const sph::Simulation& s) { force = s.grains()->walls().newton(s.global().walls[1].force[2]); });
  EXPECT_NEAR(force / 300, 1, 1e-6);
  EXPECT_NEAR(0.1 - end.x[2], 300 / 1e5, 1e-7);
}

/// A ball that meets a plate of so many of its masses, which may move askew: speeds of the two apart over together, along the
/// plate's normal, and what is gained of kinetic energy in units of what there was.
struct Impact {
  double restitution, energy;
};
Impact impact(const std::string& law, double share, const Point& direction) {
  const Files files;
  constexpr double speed = 0.5, mass = 2500 * 4 * std::numbers::pi / 3 * 1e-3;
  char rest[400];
  (void)std::snprintf(rest, sizeof rest,
                      "direction = [%g, %g, %g]\nmass = %.17g\nlargest_speed = 5\n[time]\ndt = 5e-6\n",
                      direction[0], direction[1], direction[2], share * mass);
  double plate_speed = 0;
  const Ball end = run(law + start_of(files, {{{0, 0, 0}, {0, 0, speed}, {}}}) +
                           "[domain]\nlower = [-2, -2, -2]\nupper = [2, 2, 2]\n" + plate(files, 0.11) + rest,
                       0.1, [&](const sph::Simulation& s) {
                         const auto& v = s.global().walls[0].velocity;
                         plate_speed = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
                       });
  const double norm =
      std::sqrt(direction[0] * direction[0] + direction[1] * direction[1] + direction[2] * direction[2]);
  const double away = plate_speed * direction[2] / norm - end.v[2];
  return {away / speed, (end.v[2] * end.v[2] + share * plate_speed * plate_speed) / (speed * speed) - 1};
}

// Restitution is of the two together, however light the plate is; without losses their energy stays.
TEST(DrivenMeshes, MassesAreHitAsGrainsAre) {
  const std::string group = "[[group]]\nname = \"steel\"\nkind = \"grain\"\ndiameter = 0.2\ndensity = 2500\n";
  const std::string dashpot = "[contact]\nlaw = \"linear\"\n" + group + "normal_stiffness = 1e5\n",
                    hertz =
                        "[contact]\nlaw = \"hertz\"\n" + group + "young_modulus = 1e8\npoisson_ratio = 0.3\n";
  for (const auto& law : {dashpot, hertz})
    for (const double share : {0.1, 1.0, 30.0}) {
      const Impact elastic = impact(law + "restitution = 1\n", share, {0, 0, 1});
      const Impact lossy = impact(law + "restitution = 0.6\n", share, {0, 0, 1});
      const Impact askew = impact(law + "restitution = 0.6\n", share, {3, 0, 4});
      EXPECT_NEAR(elastic.restitution, 1, 2e-3) << share;
      EXPECT_NEAR(elastic.energy, 0, 4e-3) << share;
      EXPECT_NEAR(lossy.restitution, 0.6, 6e-3) << share;
      EXPECT_NEAR(askew.restitution, 0.6, 6e-3) << share;
    }
}

std::string said_of(const std::string& text) {
  try {
    run(text, 1e-4);
  } catch (const sph::InputError& error) {
    return error.what();
  }
  return "nothing";
}

// As fast as what is farthest from the axis, wherever on it the centre is.
TEST(DrivenMeshes, MayNotTurnPastGrains) {
  const Files files;
  const auto told = [&](const char* spin) {
    return said_of(pressed(files, 0) + "axis = [1, 0, 0]\ncentre = [1000, 0, 0.203]\nspin = " + spin +
                   "\n[time]\ndt = 1e-4\n");
  };
  EXPECT_EQ(told("300"), "nothing");  // 1.5 m from the axis: 45 mm a step
  EXPECT_NE(told("900").find("mesh.spin: mesh \"plate\" at 1350 m/s"), std::string::npos) << told("900");
}

}  // namespace
