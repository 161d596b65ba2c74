// What any normal law must keep, whose restitution is that of head-on impacts: the same from both sides and in
// all lanes, the restitution asked for at any speed, never an impact that gains, and never a rolling spring that
// gives more than it took.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "contact_symmetry.hpp"
#include "sph/laws/contact/law.hpp"

namespace sph::test {

/// Eight head-on impacts of two equal spheres at `speed`, of these restitutions, in steps of 1/500 of the
/// shortest contact of a linear spring.
template <class Law>
Pair<Law, NoFriction> head_on(const LawConstants& material, const double (&restitutions)[8], double speed) {
  constexpr double radius = 0.01, mass = 0.01, deepest = 0.002;  // mass: of the pair
  Pair<Law, NoFriction> p;
  PairConstants k[8];
  double stiffest = 0;
  for (int l = 0; l < 8; ++l) {
    k[l] = Law::constants({material, material, restitutions[l], false, 0, 0});
    stiffest = std::max(stiffest, Law::stiffness(k[l], radius, deepest));
  }
  p.k.stiffness = lanes([&](int l) { return k[l].stiffness; });
  p.k.shear_stiffness = lanes([&](int l) { return k[l].shear_stiffness; });
  p.k.damping = lanes([&](int l) { return k[l].damping; });
  p.i.radius = p.j.radius = radius;
  p.i.inverse_mass = p.j.inverse_mass = 0.5 / mass;
  p.i.x[0] = -2 * radius;
  p.i.v[0] = speed;
  p.dt = linear_contact_time(stiffest, mass) / 500;
  return p;
}

/// One contact that is pressed, let go and rolled about any axis of its plane, one thing in a step, in a random
/// order: by how much what its rolling spring holds, T^2 / (2 k_r), rises beyond the work that rolls it, at most, in
/// what it holds at its limit at the largest overlap. Where that is never above 0 no closed cycle gains.
template <class Law>
double rolling_gain(const LawConstants& material, const double (&restitutions)[8], std::uint64_t seed) {
  constexpr double radius = 0.01, deepest = 0.002;
  Values values(seed);
  const auto start = head_on<Law>(material, restitutions, 1.0);
  ContactConstants<V> k = start.k;
  k.rolling_friction = 0.2;
  Contact<V> c{};
  c.normal[0] = 1, c.normal[1] = c.normal[2] = 0;
  c.radius = radius, c.mass = 0.01, c.dt = 1;
  c.separation = 0;
  c.overlap = deepest;
  V fresh[Law::history.size() + 1]{};
  const V unit =
      normal_force<Law>(c, k, fresh).elastic * c.overlap / V(4.5);  // T = mu_r R F, k_r = 2.25 F/d (T/F)^2
  V spring[3]{}, torque[3]{}, memory[Law::history.size() + 1]{}, held = V::zero(), worst = V::zero();
  for (int n = 0; n < 400; ++n) {
    const bool rolls = values.next() % 2 == 0;
    const V before = c.overlap, last[3] = {torque[0], torque[1], torque[2]};
    if (!rolls) c.overlap = lanes([&](int) { return values.uniform(1e-3, 1) * deepest; });
    c.separation = before - c.overlap;
    // A spring at its limit has turned by d / (2.25 mu_r R).
    for (int a = 0; a < 3; ++a)
      c.roll[a] = lanes([&](int) { return a > 0 && rolls ? values.uniform(-0.3, 0.3) : 0.0; });
    const NormalForce<V> normal = normal_force<Law>(c, k, memory);
    RollingSpring::torque(c, k, normal, Law::rolling_change(c, k, normal, memory), spring, torque);
    V work = V::zero(), square = V::zero();  // done by the torque
    for (int a = 0; a < 3; ++a) {
      work += V(0.5) * (last[a] + torque[a]) * c.roll[a];
      square += torque[a] * torque[a];
    }
    const V arm = k.rolling_friction * c.radius;
    const V stiffness = V(2.25) * normal.elastic / c.overlap * arm * arm;
    const V holds = V(0.5) * square / max(stiffness, V(1e-300));
    worst = max(worst, (holds - held + work) / unit);
    held = holds;
  }
  double gain = 0;
  for (int l = 0; l < V::lanes; ++l) gain = std::max(gain, worst[l]);
  return gain;
}

template <class Law>
void expect_law(const LawConstants& material, double tolerance) {
  constexpr double wanted[8] = {0.1, 0.2, 0.3, 0.5, 0.7, 0.8, 0.9, 1.0};
  EXPECT_EQ(exchange<Law>(1).wrong, 0);
  EXPECT_EQ(permutation<Law>(2).wrong, 0);
  for (std::uint64_t seed = 0; seed < 50; ++seed)
    EXPECT_LT(rolling_gain<Law>(material, wanted, seed), 1e-12) << seed;
  for (const double speed : {1e-3, 0.1, 1.0}) {
    auto p = head_on<Law>(material, wanted, speed);
    V lowest = p.kinetic_energy(), highest = lowest;
    const V start = lowest;
    bool apart = false;
    for (int n = 0; n < 100000 && !apart; ++n) {
      const auto before = p;
      p.step();
      const V energy = whole_energy(before, p);
      highest = max(highest, start + (energy - lowest));
      lowest = min(lowest, energy);
      apart = true;
      for (int l = 0; l < 8; ++l) apart = apart && (p.j.v[0] - p.i.v[0])[l] > 0 && p.contact.overlap[l] <= 0;
    }
    EXPECT_TRUE(apart);
    for (int l = 0; l < 8; ++l) {
      EXPECT_NEAR((p.j.v[0] - p.i.v[0])[l] / speed, wanted[l], tolerance) << wanted[l] << " at " << speed;
      EXPECT_LE(highest[l] / start[l], 1 + 1e-4) << wanted[l] << " at " << speed;
    }
  }
}

}  // namespace sph::test
