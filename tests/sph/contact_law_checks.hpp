// What any normal law must keep, whose restitution is that of head-on impacts: the same from both sides and in
// all lanes, the restitution asked for at any speed, and never an impact that gains.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "contact_symmetry.hpp"
#include "sph/contact/law.hpp"

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

template <class Law>
void expect_law(const LawConstants& material, double tolerance) {
  EXPECT_EQ(exchange<Law>(1).wrong, 0);
  EXPECT_EQ(permutation<Law>(2).wrong, 0);
  constexpr double wanted[8] = {0.1, 0.2, 0.3, 0.5, 0.7, 0.8, 0.9, 1.0};
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
