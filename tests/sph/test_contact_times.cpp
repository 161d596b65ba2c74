// Durations and limits of time_step.hpp, measured on the laws; a grain at rest and one that bounces.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "contact_fixture.hpp"
#include "sph/laws/contact/restitution.hpp"
#include "sph/laws/contact/time_step.hpp"

namespace sph {
namespace {

using std::numbers::pi;
using test::lanes;
using test::Pair;
using test::V;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double g = 9.81, radius = 0.05, stiffness = 1e5, mass = 0.5;
constexpr double restitutions[8] = {1.0, 0.9, 0.7, 0.5, 0.3, 0.2, 0.15, 0.1};

template <class Normal, class Friction = NoFriction>
Pair<Normal, Friction> on_floor() {
  Pair<Normal, Friction> p;
  p.wall = true;
  p.j.radius = radius;
  p.j.inverse_mass = 1 / mass;
  p.j.x[1] = radius;
  p.k.stiffness = std::is_same_v<Normal, HertzNormal> ? 1e7 : stiffness;
  return p;
}

TEST(ContactTimes, Duration) {
  for (const bool pull : {false, true}) {
    auto p = on_floor<LinearNormal>();
    p.k.damping = lanes([&](int l) { return damping_of(LinearNormal::impact, pull, restitutions[l]); });
    p.k.least_force = pull ? -infinity : 0.0;
    p.j.v[1] = -1.0;
    const double time = linear_contact_time(stiffness, mass);
    p.dt = time / 2000;
    V pressing = V::zero(), touching = V::zero();
    for (int n = 0; n < 12000; ++n) {
      p.step();
      touching += test::where_positive(p.contact.overlap, p.dt);
      pressing += test::where_positive(p.contact.overlap, test::where_positive(p.normal.force, p.dt));
    }
    for (int l = 0; l < V::lanes; ++l) {
      const double zeta = damping_ratio(pull, restitutions[l]), t = std::acos(std::min(zeta, 1.0)),
                   u = std::acosh(std::max(zeta, 1.0));
      // As time_step.hpp says; sin t = sqrt(1 - zeta^2) in both.
      const double wanted = pull ? pi / std::sin(t) : zeta < 1 ? 2 * t / std::sin(t) : 2 * u / std::sinh(u);
      EXPECT_NEAR((pull ? touching : pressing)[l] / time * pi / wanted, 1, 3e-3) << restitutions[l];
    }
  }
}

TEST(ContactTimes, PublishedValues) {
  EXPECT_NEAR(rayleigh_time(0.01, 2800, 48e9, 0.20), 12.93e-6, 5e-9);      // glass
  EXPECT_NEAR(rayleigh_time(2.5e-3, 4000, 380e9, 0.23), 1.383e-6, 5e-10);  // alumina
  EXPECT_EQ(packing_step(4.0, 16.0), 0.17 * 2.0);
  EXPECT_EQ(linear_stable_step(4.0, 16.0, 0.0), 4.0);
  EXPECT_NEAR(linear_stable_step(4.0, 16.0, 0.75), 2.0, 1e-15);
}

// A grain at rest on the floor, disturbed: quiet 1 % below the limit, thrown up 1 % above it.
TEST(ContactTimes, NormalLimit) {
  constexpr double zeta[8] = {0.0, 0.05, 0.1, 0.3, 0.5, 1.0, 2.0, 5.0};
  for (const double share : {0.99, 1.01}) {
    auto p = on_floor<LinearNormal>();
    p.gravity[1] = -g;
    p.k.damping = lanes([&](int l) { return 2 * zeta[l]; });
    p.k.least_force = -infinity;
    const double overlap = mass * g / stiffness;
    p.j.x[1] = radius - overlap * (1 + 1e-6);
    p.dt = lanes([&](int l) { return share * linear_stable_step(stiffness, mass, zeta[l]); });
    p.steps(3000);
    for (int l = 0; l < V::lanes; ++l) {
      const double moved = std::abs(radius - overlap - p.j.x[1][l]) / overlap;
      if (share < 1) {
        EXPECT_LT(moved, 2e-5) << zeta[l];
      } else {
        EXPECT_GT(moved, 1e-2) << zeta[l];
      }
    }
  }
}

// The same of the tangential spring and dashpot, on the mass 2/7 m of a surface that also turns; k_t = 100
// k_n so that it is the one that decides. Beyond the limit the contact slides to and fro.
TEST(ContactTimes, TangentialLimit) {
  constexpr double shear_damping[8] = {0.0, 0.1, 0.2, 0.5, 1, 2, 5, 10};
  for (const double share : {0.99, 1.01}) {
    auto p = on_floor<LinearNormal, Coulomb>();
    p.gravity[1] = -g;
    p.k.damping = 0.2;
    p.k.friction = 0.5;
    p.k.shear_stiffness = 100 * stiffness;
    p.k.shear_damping = lanes([&](int l) { return shear_damping[l]; });
    p.j.x[1] = radius - mass * g / stiffness;
    p.j.v[0] = 1e-9;
    p.dt = lanes([&](int l) {
      const double k = 100 * stiffness, m = 2.0 / 7 * mass;
      const double dashpot = shear_damping[l] * 0.2 * std::sqrt(stiffness * mass);
      return share * linear_stable_step(k, m, dashpot / (2 * std::sqrt(k * m)));
    });
    p.steps(3000);
    for (int l = 0; l < V::lanes; ++l) {
      const double slip = std::abs(p.contact.slip[0][l]);
      if (share < 1) {
        EXPECT_LT(slip, 2e-8) << shear_damping[l];
      } else {
        EXPECT_GT(slip, 1e-4) << shear_damping[l];
      }
    }
  }
}

TEST(ContactTimes, OverlapAtRest) {
  auto linear = on_floor<LinearNormal>();
  auto hertz = on_floor<HertzNormal>();
  const V weight = lanes([](int l) { return 0.5 * (l + 1); });
  const auto settle = [&](auto& p, const ReducedImpact& law) {
    p.gravity[1] = V::zero() - weight / V(mass);
    p.k.damping = damping_of(law, false, 0.3);
    p.dt = 2e-5;
    p.steps(100000);
  };
  settle(linear, LinearNormal::impact);
  settle(hertz, HertzNormal::impact);
  for (int l = 0; l < V::lanes; ++l) {
    EXPECT_NEAR((radius - linear.j.x[1][l]) / (weight[l] / stiffness), 1, 1e-9);
    const double overlap = std::pow(0.75 * weight[l] / (1e7 * std::sqrt(radius)), 2.0 / 3);
    EXPECT_NEAR((radius - hertz.j.x[1][l]) / overlap, 1, 1e-9);
  }
}

// Dropped from a height above the floor: rises to e^2 of it.
TEST(ContactTimes, Bounce) {
  auto p = on_floor<HertzNormal>();
  const double height = 0.5;
  constexpr double e[8] = {1.0, 0.95, 0.9, 0.8, 0.7, 0.6, 0.55, 0.5};
  p.k.stiffness = 1e8;
  p.k.damping = lanes([&](int l) { return damping_of(HertzNormal::impact, false, e[l]); });
  p.gravity[1] = -g;
  p.j.x[1] = radius + height;
  const double speed = std::sqrt(2 * g * height);
  p.dt = hertz_contact_time(1e8, radius, mass, speed) / 500;
  V highest = V::zero();
  bool met = false;
  for (double t = 0; t < 2.1 * speed / g; t += p.dt[0]) {
    p.step();
    if (t > 1.05 * speed / g) met = true;  // all are past the contact
    if (met) highest = max(highest, p.j.x[1] - V(radius));
  }
  for (int l = 0; l < V::lanes; ++l) EXPECT_NEAR(highest[l] / height / (e[l] * e[l]), 1, 1e-2) << e[l];
}

}  // namespace
}  // namespace sph
