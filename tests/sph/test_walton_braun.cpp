// The latched springs of Walton & Braun: the restitution of head-on impacts is sqrt(k_1/k_2) at any speed, and
// the latch only ever takes energy. Bits over ranks and restarts: the scene "latched" of tests/system.
#include <gtest/gtest.h>

#include "contact_symmetry.hpp"
#include "sph/contact/walton_braun.hpp"

namespace sph {
namespace {

using test::lanes;
using test::V;

TEST(WaltonBraun, RestitutionOfImpactsThatNeverGain) {
  constexpr double wanted[8] = {0.1, 0.2, 0.3, 0.5, 0.7, 0.8, 0.9, 1.0},
                   speed[8] = {1, 1e-3, 10, 1, 5, 1, 0.1, 1};
  test::Pair<WaltonBraun> p;
  const LawConstants springs{1e5, 2e4};
  const auto constant = [&](double PairConstants::*which) {
    return lanes([&](int l) {
      return WaltonBraun::constants({springs, springs, wanted[l], false, 0, 0}).*which;
    });
  };
  p.k.stiffness = constant(&PairConstants::stiffness);
  p.k.damping = constant(&PairConstants::damping);
  p.i.x[0] = -2.0;
  p.i.v[0] = lanes([&](int l) { return speed[l]; });
  p.i.inverse_mass = p.j.inverse_mass = 50.0;  // m* = 0.01 kg
  p.dt = linear_contact_time(1e7, 0.01) / 500;
  V lowest = p.kinetic_energy();
  for (int n = 0; n < 8000; ++n) {
    const auto before = p;
    p.step();
    const V energy = test::whole_energy(before, p);
    for (int l = 0; l < 8; ++l) EXPECT_LE(energy[l], lowest[l] * (1 + 2e-5)) << wanted[l] << " in step " << n;
    lowest = min(lowest, energy);
  }
  for (int l = 0; l < 8; ++l) EXPECT_NEAR((p.j.v[0] - p.i.v[0])[l] / speed[l], wanted[l], 2e-3) << wanted[l];
}

TEST(WaltonBraun, IsTheSameFromBothSidesAndInAllLanes) {
  EXPECT_EQ(test::exchange<WaltonBraun>(1).wrong, 0);
  EXPECT_EQ(test::permutation<WaltonBraun>(2).wrong, 0);
}

}  // namespace
}  // namespace sph
