// Rigid bodies that move as they are told: what acts on them, and the flow that they make.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "accuracy/light_cylinder.hpp"
#include "accuracy/pinned.hpp"

namespace {

using measure::Sample, measure::samples, measure::run_until, measure::text;
using sph::BodyState;

/// A round tank, full and closed, with a cylinder in its middle; lengths are in spacings.
std::string tank(double radius, double outer, const std::string& more) {
  const auto ball = [](const char* group, double r) {
    return std::string("[[start.region]]\ngroup = \"") + group +
           "\"\nshape = \"ball\"\ncentre = [0, 0]\nradius = " + std::to_string(r) + "\n";
  };
  const std::string corner = std::to_string(outer + 5);
  return "dimension = 2\nkernel = { h_over_dx = 1.2 }\n[domain]\nlower = [-60, -60]\nupper = [60, 60]\n"
         "[[group]]\nname = \"water\"\nkind = \"fluid\"\ndensity = 1000\n[[group]]\nname = "
         "\"cylinder\"\nkind = "
         "\"solid\"\nrigid = true\ndensity = 1000\n[[group]]\nname = \"wall\"\nkind = "
         "\"wall\"\n[start]\nspacing = "
         "1\nlower = [-" +
         corner + ", -" + corner + "]\nupper = [" + corner + ", " + corner +
         "]\n[[start.region]]\ngroup = \"none\"\n" + ball("wall", outer + 4) + ball("water", outer) +
         ball("cylinder", radius) + "[time]\nuntil = 10\n" + more;
}

// Without viscosity the water resists as rho pi R^2 (b^2 + R^2) / (b^2 - R^2) times the acceleration (Lamb, art. 71).
TEST(Led, ACylinderThatIsDrivenFeelsTheMassOfTheWater) {
  constexpr double radius = 12, outer = 48, way = 0.5, end = 0.3, acceleration = 2 * way / (end * end);
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s(
      comm,
      sph::parse_scene(
          tank(radius, outer, ""), "tank.toml",
          {"group.water.sound_speed=3000", "group.wall.slip=true", "start.pressure=uniform",
           text("start.uniform_pressure", 2000 * acceleration * radius),
           "group.cylinder.motion.velocity=[[0, 0], " + text("", end, acceleration * end).substr(1) + "]"}));
  const BodyState& body = s.global().bodies.front();
  const double area = body.shape.mass / 1000, r2 = area / std::numbers::pi;
  const double exact = -1000 * area * (outer * outer + r2) / (outer * outer - r2) * acceleration;
  double weight = 0, force = 0, off = 0;
  run_until(s, end, [&] {
    const double t = s.global().time;
    if (t > end) return;
    off = std::max(off, std::abs(s.scale().metres(body.motion.centre[0]) - 0.5 * acceleration * t * t));
    const double w = 1 - std::cos(2 * std::numbers::pi * t / end);  // waves of sound are weighed down
    weight += w;
    force += w * body.load.force[0];
  });
  const double over = force / weight / exact - 1;
  std::printf("cylinder driven, R = %.0f dx: force %+.2f %%, off its way %.1e dx, %ld steps\n", radius,
              100 * over, off, static_cast<long>(s.global().step));
  EXPECT_LT(off, 1e-9);
  EXPECT_NEAR(PINNED(over), 0, 0.035);
}

// u = A r + B / r between cylinders, torque 4 pi mu omega R1^2 R2^2 / (R2^2 - R1^2) per length.
TEST(Led, StirsAsCouetteHasIt) {
  constexpr double inner = 12, outer = 24, viscosity = 5e4, sound = 120, spin = 0.3;
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s(
      comm,
      sph::parse_scene(tank(inner, outer, ""), "couette.toml",
                       {text("group.water.sound_speed", sound), text("group.water.viscosity", viscosity),
                        "group.cylinder.motion.spin=[[0, 0], [0.3, 0.3]]", "start.pressure=uniform",
                        "start.uniform_pressure=2e5", "terms.shifting=true"}));
  run_until(s, 3);
  const BodyState& body = s.global().bodies.front();
  // Of the particles, as they are painted.
  const double r1 = std::sqrt(body.shape.mass / 1000 / std::numbers::pi), a2 = r1 * r1, b2 = outer * outer;
  double error = 0, norm = 0;
  for (const Sample& q : samples(s)) {
    if (s.scene().groups[q.group].kind != sph::GroupKind::fluid) continue;
    const double r = std::hypot(q.x[0], q.x[1]), u = spin * a2 / (b2 - a2) * (b2 / r - r);
    const double e0 = q.v[0] + u * q.x[1] / r, e1 = q.v[1] - u * q.x[0] / r;
    error += e0 * e0 + e1 * e1;
    norm += u * u;
  }
  const double torque =
      body.load.torque[2] / (-4 * std::numbers::pi * viscosity * spin * a2 * b2 / (b2 - a2)) - 1;
  const double flow = std::sqrt(error / norm);
  std::printf(
      "Couette flow between cylinders of %.0f and %.0f dx: torque %+.2f %%, velocity %.2f %%, turned by "
      "%.12f\n",
      inner, outer, 100 * torque, 100 * flow, body.motion.angle);
  EXPECT_NEAR(body.motion.angle, spin * (0.15 + s.global().time - 0.3), 1e-12);
  EXPECT_NEAR(PINNED(torque), 0, 0.05);
  EXPECT_LT(PINNED(flow), 0.03);
}

/// In a tank, 15 dx off its middle, after a third of a turn: the mean acceleration, in whose frame the fluid's pressure goes on.
BodyState circled(const std::string& centre, const std::string& velocity) {
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s(
      comm, sph::parse_scene(
                tank(6, 30, ""), "tank.toml",
                {"group.water.sound_speed=150", "group.water.viscosity=5e4", "group.cylinder.motion.spin=1",
                 "group.cylinder.motion.centre=" + centre, "group.cylinder.motion.velocity=" + velocity,
                 "start.region.3.centre=[15, 0]", "start.pressure=uniform", "start.uniform_pressure=1e6"}));
  run_until(s, 2);
  const BodyState& body = s.global().bodies.front();
  const double x = s.scale().metres(body.motion.centre[0]), y = s.scale().metres(body.motion.centre[1]),
               t = s.global().time;
  if (centre == "[0, 0]") {
    EXPECT_NEAR(x, 15 * std::cos(t), 1e-9);
    EXPECT_NEAR(y, 15 * std::sin(t), 1e-9);
  }
  return body;
}

TEST(Led, ABodyThatCirclesIsPulledToItsAxis) {
  const BodyState round = circled("[0, 0]", "0"), on = circled("[15, 0]", "-1");
  EXPECT_NEAR(std::hypot(round.load.acceleration[0], round.load.acceleration[1]), 15, 0.15);
  EXPECT_NEAR(std::hypot(round.motion.velocity[0], round.motion.velocity[1]), 15, 1e-9);
  // One that travels and turns about itself is not accelerated.
  EXPECT_NEAR(std::hypot(on.load.acceleration[0], on.load.acceleration[1]), 0, 1e-9);
  EXPECT_NEAR(on.motion.velocity[1], 0, 1e-12);
}

}  // namespace
