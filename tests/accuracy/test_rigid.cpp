// Rigid bodies: free rotation, the limit of stiff bodies in a fluid, added mass, momentum, contacts, what is held.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "accuracy/light_cylinder.hpp"
#include "accuracy/pinned.hpp"
#include "sph/models/rigid_motion.hpp"

namespace {

using measure::Sample, measure::samples, measure::run_until, measure::text, measure::energy_of;
using sph::BodyState, sph::Vector3, sph::Matrix3;

constexpr const char* brick = R"(
dimension = 3
kernel = { h_over_dx = 1 }
domain = { lower = [0, 0, 0], upper = [30, 30, 30], periodic = [true, true, true] }
[[group]]
name = "brick"
kind = "solid"
rigid = true
density = 1000
sound_speed = 10
start_spin = [0.01, 1, 0.005]
start_velocity = [0.3, 0.2, -0.1]
[start]
spacing = 1
region = [{ group = "none" }, { group = "brick", shape = "box", lower = [11, 12, 13], upper = [21, 18, 16] }]
[time]
dt = 0.02
until = 60
)";

/// What a particle lies off where its body has it, over the quantum of positions.
double distortion(const sph::Simulation& s, const std::vector<Sample>& start) {
  const std::vector<Sample> now = samples(s);
  const std::uint64_t* id = s.particles().data<sph::Field::id>();
  double most = 0;
  std::size_t first = 0;
  for (std::size_t k = 0; k < now.size(); ++k)
    if (id[k] < id[first]) first = k;
  for (std::size_t k = 0; k < now.size(); ++k) {
    double before = 0, after = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      const double period = s.scene().domain.upper[a] - s.scene().domain.lower[a];
      const auto near = [&](double x) {
        return s.scene().domain.periodic[a] ? std::remainder(x, period) : x;
      };
      const double x = near(start[id[k]].x[a] - start[id[first]].x[a]),
                   y = near(now[k].x[a] - now[first].x[a]);
      before += x * x;
      after += y * y;
    }
    most = std::max(most, std::abs(std::sqrt(after) - std::sqrt(before)));
  }
  return most / s.scale().quantum;
}

/// By id.
std::vector<Sample> by_id(const sph::Simulation& s) {
  const std::vector<Sample> all = samples(s);
  const std::uint64_t* id = s.particles().data<sph::Field::id>();
  std::uint64_t most = 0;
  for (std::size_t k = 0; k < all.size(); ++k) most = std::max(most, id[k]);
  std::vector<Sample> out(most + 1);
  for (std::size_t k = 0; k < all.size(); ++k) out[id[k]] = all[k];
  return out;
}

/// Euler's equations in the body's frame, by steps so short that they are exact here.
Vector3 euler(Vector3 spin, const Matrix3& inertia, double time) {
  const Vector3 i = inertia.diagonal();
  const auto rate = [&](const Vector3& w) {
    return Vector3((i[1] - i[2]) / i[0] * w[1] * w[2], (i[2] - i[0]) / i[1] * w[2] * w[0],
                   (i[0] - i[1]) / i[2] * w[0] * w[1]);
  };
  constexpr int steps = 200'000;
  const double dt = time / steps;
  for (int k = 0; k < steps; ++k) {
    const Vector3 a = rate(spin), b = rate(spin + 0.5 * dt * a), c = rate(spin + 0.5 * dt * b),
                  d = rate(spin + dt * c);
    spin += dt / 6 * (a + 2 * (b + c) + d);
  }
  return spin;
}

struct Spun {
  double off;  ///< angular velocity in the body's frame, over the first
  double energy, momentum, shape;
  double lowest;  ///< that about the intermediate axis, over the first
};

Spun spin_brick(double dt) {
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s(comm, sph::parse_scene(brick, "brick.toml", {text("time.dt", dt)}));
  const std::vector<Sample> start = by_id(s);
  const auto body = [&]() -> const BodyState& { return s.global().bodies.front(); };
  const auto momentum = [&] {  // of the particles, about the centre
    Vector3 sum = Vector3::Zero();
    const double* arm = s.particles().data<sph::Field::arm>();
    const Matrix3 r = sph::rotation_of(body().motion.turn);
    const std::vector<Sample> all = samples(s);
    for (std::size_t k = 0; k < all.size(); ++k)
      sum += all[k].mass * (r * Vector3(arm[3 * k], arm[3 * k + 1], arm[3 * k + 2]))
                               .cross(Vector3(all[k].v[0], all[k].v[1], all[k].v[2]));
    return sum;
  };
  const Vector3 before = momentum(), spin = sph::vector_of(body().motion.spin);
  const double energy = energy_of(s);
  Spun out{0, 0, 0, 0, 1};
  run_until(s, 60 - 0.5 * dt, [&] {
    const Matrix3 r = sph::rotation_of(body().motion.turn);
    out.lowest = std::min(out.lowest, (r.transpose() * sph::vector_of(body().motion.spin))[1] / spin[1]);
    out.energy = std::max(out.energy, std::abs(energy_of(s) / energy - 1));
  });
  out.momentum = (momentum() - before).norm() / before.norm();
  out.shape = distortion(s, start);
  const Vector3 now = sph::rotation_of(body().motion.turn).transpose() * sph::vector_of(body().motion.spin);
  out.off = (now - euler(spin, sph::inertia_of(body().shape), s.global().time)).norm() / spin.norm();
  return out;
}

// About its intermediate axis a brick tumbles; through the faces of the period, for 60 rad.
TEST(Rigid, BrickTumbles) {
  const Spun coarse = spin_brick(0.04), fine = spin_brick(0.02);
  std::printf(
      "brick: spin off by %.2e, %.2e; energy within %.1e, momentum %.1e, shape %.2f quanta, lowest %.3f\n",
      coarse.off, fine.off, fine.energy, fine.momentum, fine.shape, fine.lowest);
  EXPECT_LT(fine.lowest, -0.95);  // it has turned over
  EXPECT_LT(coarse.energy, 1e-12);
  EXPECT_LT(fine.energy, 1e-12);
  EXPECT_LT(fine.momentum, 1e-13);
  EXPECT_LT(fine.shape, 2);
  EXPECT_NEAR(PINNED(std::log2(coarse.off / fine.off)), 2, 0.1);
  EXPECT_LT(PINNED(fine.off), 1e-4);
}

TEST(Rigid, BarSpins) {
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s(comm, sph::parse_scene(R"(
dimension = 2
kernel = { h_over_dx = 1 }
domain = { lower = [0, 0], upper = [90, 90], periodic = [true, true] }
[[group]]
name = "bar"
kind = "solid"
rigid = true
density = 1000
sound_speed = 10
start_spin = 2
start_velocity = [0.3, 0.2]
[start]
spacing = 0.5
region = [{ group = "none" }, { group = "bar", shape = "box", lower = [45, 87], upper = [85, 88] }]
[time]
dt = 0.01
until = 50
)",
                                           "bar.toml", {}));
  const std::vector<Sample> start = by_id(s);
  const double energy = energy_of(s);
  run_until(s, 50);
  const BodyState& body = s.global().bodies.front();
  EXPECT_NEAR(body.motion.angle, 2 * s.global().time, 1e-10);
  EXPECT_NEAR(energy_of(s) / energy, 1, 1e-12);
  EXPECT_LT(distortion(s, start) * s.scale().quantum, 1e-13);  // as doubles have it, 85 m away
}

double rise(double dx) {
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s =
      measure::light_cylinder(comm, dx, {"group.cylinder.rigid=true", "group.cylinder.viscosity=0"});
  const double moved = measure::rise_in_a_second(s);
  std::printf("rigid cylinder, dx %.2f m: rise %.4f m at 1 s, %ld steps\n", dx, moved,
              static_cast<long>(s.global().step));
  return moved;
}

// 1.2140 m at 0.25 m; the elastic one 1.2168 m (test_wet_bodies.cpp).
TEST(Rigid, IsTheLimitOfAStiffCylinder) {
  const double coarse = rise(1), fine = rise(0.5);
  EXPECT_NEAR(PINNED(coarse), 1.2140, 0.004);
  EXPECT_NEAR(PINNED(fine), 1.2140, 0.003);
}

constexpr const char* round_tank = R"(
dimension = 2
kernel = { h_over_dx = 1.2 }
[domain]
gravity = [0, -9.81]
lower = [-60, -60]
upper = [60, 60]
[[group]]
name = "water"
kind = "fluid"
density = 1000
[[group]]
name = "cylinder"
kind = "solid"
rigid = true
[[group]]
name = "wall"
kind = "wall"
slip = true
[start]
spacing = 1
pressure = "hydrostatic"
[[start.region]]
group = "none"
[[start.region]]
group = "wall"
shape = "ball"
centre = [0, 0]
radius = 1
[[start.region]]
group = "water"
shape = "ball"
centre = [0, 0]
radius = 1
[[start.region]]
group = "cylinder"
shape = "ball"
centre = [0, 0]
radius = 1
[time]
until = 10
)";

// A cylinder that is let go in the middle of a round tank, full and closed: what it drags along is, without viscosity,
// rho pi R^2 (b^2 + R^2) / (b^2 - R^2), with b the radius of the tank (Lamb, art. 71).
/// Its acceleration over the exact one, less 1; lengths are in spacings, `wide` in radii.
double let_go(double ratio, double density, double wide) {
  const double b = wide * ratio, g = 9.81, sound = 240 * std::sqrt(g * 2 * b);
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s(
      comm, sph::parse_scene(
                round_tank, "tank.toml",
                {text("group.water.sound_speed", sound), text("group.cylinder.density", density * 1000),
                 text("start.region.1.radius", b + 4), text("start.region.2.radius", b),
                 text("start.region.3.radius", ratio), text("start.surface_height", b),
                 text("start.lower", -b - 5, -b - 5), text("start.upper", b + 5, b + 5)}));
  const BodyState& body = s.global().bodies.front();
  // Of the particles, as they are painted.
  const double area = body.shape.mass / (density * 1000), r2 = area / std::numbers::pi;
  const double added = (b * b + r2) / (b * b - r2);
  const double exact = (1 - density) / (density + added) * g;
  const double end = std::sqrt(0.02 * ratio / std::abs(exact));
  // Velocity against time, where waves of sound are weighed down.
  double tt = 0, tv = 0;
  run_until(s, end, [&] {
    const double t = s.global().time;
    const double w = 1 - std::cos(2 * std::numbers::pi * s.global().time / end);
    tt += w * t * t;
    tv += w * t * body.motion.velocity[1];
  });
  const double over = tv / tt / exact - 1;
  std::printf("cylinder of %.1f let go, R = %.1f dx, tank %.0f R: acceleration %+.2f %%, %ld steps\n",
              density, ratio, wide, 100 * over, static_cast<long>(s.global().step));
  return over;
}

TEST(Rigid, DragsTheMassOfTheWater) {
  EXPECT_NEAR(PINNED(let_go(12, 0.5, 4)), 0, 0.02);
  EXPECT_NEAR(PINNED(let_go(7.5, 2, 4)), 0, 0.02);
}

}  // namespace
