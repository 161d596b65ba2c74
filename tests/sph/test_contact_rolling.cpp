// Rolling resistance: the deceleration it should give, and what is left when a grain has stopped.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "contact_law_checks.hpp"

namespace sph {
namespace {

using test::lanes;
using test::Pair;
using test::V;

constexpr double g = 9.81, radius = 0.05;
constexpr double rolling[8] = {0.01, 0.02, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3};

/// At rest on the plane y = 0 under its weight.
template <class Normal, class Friction>
Pair<Normal, Friction, RollingSpring> resting(double stiffness) {
  Pair<Normal, Friction, RollingSpring> p;
  p.wall = true;
  p.j.radius = radius;
  p.j.inverse_mass = 1.0;
  p.k = {V(stiffness), V(2.0 / 7 * stiffness),
         V(0.4),       V(1.0),
         V(0.8),       lanes([](int l) { return rolling[l]; }),
         V(0.0),       V(0.0),
         V(0.0)};
  p.gravity[1] = -g;
  const double overlap = std::is_same_v<Normal, HertzNormal>
                             ? std::pow(0.75 * g / (stiffness * std::sqrt(radius)), 2.0 / 3)
                             : g / stiffness;
  p.j.x[1] = radius - overlap;
  p.dt = 2e-5;
  return p;
}

template <class Normal, class Friction>
void spin_down(double stiffness, double per_radian) {
  auto p = resting<Normal, Friction>(stiffness);
  const double w0 = -20;
  p.j.w[2] = w0;
  if (Friction::history > 0) p.j.v[0] = -w0 * radius;
  constexpr int steps = 5000;  // 0.1 s
  p.steps(steps);
  const double overlap = radius - p.j.x[1][0];
  for (int l = 0; l < V::lanes; ++l) {
    // The spring first winds up to its limit, in an angle d / (2.25 mu_r R): half a torque for that time.
    const double winding = overlap / (2.25 * rolling[l] * radius) / -w0;
    const double slowing = per_radian * rolling[l] * g / radius * (steps * p.dt[l] - 0.5 * winding);
    EXPECT_NEAR((p.j.w[2][l] - w0) / slowing, 1, 1e-3) << rolling[l];
    if (Friction::history > 0) {
      EXPECT_NEAR(p.j.v[0][l] / (-p.j.w[2][l] * radius), 1, 1e-3) << rolling[l];
    }
    EXPECT_EQ(p.j.w[0][l], 0.0);
  }
}

// I w' = -mu_r R N turning in place on a smooth plane; (I + m R^2) w' of the same while rolling.
TEST(ContactRolling, SpinDownInPlace) {
  spin_down<LinearNormal, NoFriction>(1e6, 2.5);
  spin_down<HertzNormal, NoFriction>(1e8, 2.5);
}
TEST(ContactRolling, SpinDownRolling) {
  spin_down<LinearNormal, Coulomb>(1e6, 2.5 / 3.5);
  spin_down<HertzNormal, Coulomb>(1e8, 2.5 / 3.5);
}

TEST(ContactRolling, SpinAboutTheNormalIsFree) {
  auto p = resting<LinearNormal, Coulomb>(1e6);
  p.j.w[1] = 3.0;
  p.steps(1000);
  for (int l = 0; l < V::lanes; ++l) EXPECT_EQ(p.j.w[1][l], 3.0);
}

// Rolling to and fro about the contact with a plane is a damped oscillator of that fraction of the critical
// damping: its amplitude falls by exp(-2 pi eta / sqrt(1 - eta^2)) in a period.
TEST(ContactRolling, DashpotIsTheFractionOfTheCriticalOne) {
  constexpr double stiffness = 1e6, arm = 0.02, w0 = 0.01;
  static constexpr double eta[8] = {0, 0.02, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5};
  auto p = resting<LinearNormal, Coulomb>(stiffness);
  p.k.rolling_friction = arm;
  p.k.rolling_damping = lanes([](int l) { return eta[l]; });
  p.j.w[2] = w0;
  p.j.v[0] = -w0 * radius;
  const double omega = std::sqrt(2.25 * stiffness * arm * arm / 1.4);
  V amplitude = V::zero();
  for (int n = 0; n * p.dt[0] < 20 / omega; ++n) {
    p.step();
    for (int l = 0; l < V::lanes; ++l) {
      const double period = 2 * std::numbers::pi / (omega * std::sqrt(1 - eta[l] * eta[l]));
      if (n == static_cast<int>(std::lround(period / p.dt[0]))) amplitude.set(l, p.j.w[2][l]);
    }
  }
  for (int l = 0; l < V::lanes; ++l) {
    const double fall = std::exp(-2 * std::numbers::pi * eta[l] / std::sqrt(1 - eta[l] * eta[l]));
    EXPECT_NEAR(amplitude[l] / w0, fall, 5e-3) << eta[l];
  }
}

// Without a dashpot: on a smooth plane a stopped grain goes on to swing with what the spring held at its
// limit, at most limit / sqrt(k_r I), k_r = 2.25 k (mu_r R)^2: a speed that does not depend on mu_r.
// Friction's dashpot takes it away.
TEST(ContactRolling, SwingsOnAfterTheStop) {
  const auto largest_swing = [](auto p) {
    p.j.w[2] = -1.0;
    p.steps(60000);
    V largest = V::zero();
    for (int n = 0; n < 5000; ++n) {
      p.step();
      largest = max(largest, sqrt(p.j.w[2] * p.j.w[2]));
    }
    return largest;
  };
  const V smooth = largest_swing(resting<LinearNormal, NoFriction>(1e6));
  const V rough = largest_swing(resting<LinearNormal, Coulomb>(1e6));
  const double bound = g / std::sqrt(2.25 * 1e6 * 0.4 * radius * radius);
  for (int l = 0; l < V::lanes; ++l) {
    EXPECT_NEAR(smooth[l] / bound, 1, 1e-3) << rolling[l];
    EXPECT_LT(rough[l], rolling[l] < 0.1 ? 0.6 * bound : 0.4 * bound) << rolling[l];
  }
  EXPECT_LT(rough[7], 1e-9 * bound);
}

TEST(ContactRolling, SpringsGiveNoMoreThanTheyTook) {
  constexpr double e[8] = {0.1, 0.2, 0.3, 0.5, 0.7, 0.8, 0.9, 1.0};
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    EXPECT_LT(test::rolling_gain<LinearNormal>({1e5, 2e4}, e, seed), 1e-12) << seed;
    EXPECT_LT(test::rolling_gain<HertzNormal>({1e7, 0.3}, e, seed), 1e-12) << seed;
  }
}

// Overlap and roll go round a closed loop, in all phases to each other: the spring may not give energy.
TEST(ContactRolling, CyclesMakeNoEnergy) {
  Contact<V> c{};
  const ContactConstants<V> k{V(1e8), V(0.0), V(0.0), V(0.0), V(0.0), V(0.3), V(0.0), V(0.0), V(0.0)};
  c.normal[0] = 1, c.normal[1] = c.normal[2] = 0;
  c.radius = radius;
  c.mass = 1;
  c.dt = 1;
  for (V& r : c.roll) r = V::zero();
  V spring[3] = {V::zero(), V::zero(), V::zero()}, torque[3], work = V::zero(), last = V::zero();
  constexpr int steps = 2000;
  const double depth = 1e-5, swing = 1e-5;  // [rad], far below the limit
  V largest = V::zero();
  for (int n = 0; n < 4 * steps; ++n) {
    const double time = 2 * std::numbers::pi * n / steps, before = time - 2 * std::numbers::pi / steps;
    const auto at = [&](double t, int l) {
      return depth * (1 + 0.9 * std::cos(t + l * std::numbers::pi / 4));
    };
    c.overlap = lanes([&](int l) { return at(time, l); });
    c.separation = lanes([&](int l) { return at(before, l) - at(time, l); });
    c.roll[2] = swing * (std::sin(time) - std::sin(before));
    const NormalForce<V> normal = HertzNormal::force(c, k);
    RollingSpring::torque(c, k, normal, normal.shear_change, spring, torque);
    if (n >= steps) work += V(0.5) * (spring[2] + last) * c.roll[2];
    last = spring[2];
    largest = max(largest, spring[2] * V(swing));
  }
  for (int l = 0; l < V::lanes; ++l) EXPECT_LT(work[l], 0) << l << " of " << largest[l];
}

}  // namespace
}  // namespace sph
