// Chung & Ooi 2011, benchmark tests 6 to 8: spheres that spin and meet a plane or another sphere head on.
#include <gtest/gtest.h>

#include <array>

#include "contact_impact.hpp"
#include "sph/laws/contact/time_step.hpp"

namespace sph {
namespace {

using test::HertzPair;
using test::Impact;
using test::Material;
using test::on_plane;
using test::V;

constexpr Material alloy{70e9, 0.33, 2700, 0.4, 0.5}, nylon{2.5e9, 0.40, 1000, 0.4, 0.5};
constexpr double spin_ratio[8] = {0.98, 1.49, 2.99, 5.77, 8, 10, 15, 20};  // omega R / v_n

std::array<Impact, 8> spinning(const Material& m) {
  std::array<Impact, 8> cases;
  for (int l = 0; l < 8; ++l) cases[l] = {m, 0.1, 0.2, 0, spin_ratio[l] * 0.2 / 0.1};
  return cases;
}

TEST(ChungOoi, SpinningSphereOnPlane) {
  for (const Material& m : {alloy, nylon}) {
    HertzPair p = on_plane(spinning(m), 1000);
    p.steps(3000);
    for (int l = 0; l < 8; ++l) {
      const double e = p.j.v[1][l] / 0.2, change = 0.4 * (1 + e) * 0.2;
      EXPECT_NEAR(e, 0.5, 1e-3);
      // Rigid spheres slide all the time above 7/2 mu (1 + e) = 2.1. Here the dashpot's force comes before
      // the spring can follow: the contact first sticks for a time that falls with the speed of the slip.
      if (spin_ratio[l] < 5) {
        EXPECT_LT(-p.j.v[0][l], change);
      } else {
        EXPECT_NEAR(-p.j.v[0][l] / change, 1, 0.05 / spin_ratio[l]) << spin_ratio[l];
        EXPECT_NEAR((p.j.w[2][l] - spin_ratio[l] * 2) / (-2.5 * change / 0.1), 1, 0.05 / spin_ratio[l])
            << spin_ratio[l];
      }
    }
  }
}

TEST(ChungOoi, TwoSpheresSpinningAgainstEachOther) {
  for (const Material& m : {alloy, nylon}) {
    HertzPair p = on_plane(spinning(m), 1000);
    p.wall = false;
    p.i = p.j;
    for (int a = 0; a < 3; ++a) {
      p.i.x[a] = V::zero() - p.j.x[a];
      p.i.v[a] = V::zero() - p.j.v[a];
      p.i.w[a] = V::zero() - p.j.w[a];
    }
    p.steps(3000);
    for (int l = 0; l < 8; ++l) {
      EXPECT_EQ(p.j.w[2][l], spin_ratio[l] * 0.2 / 0.1);
      EXPECT_EQ(p.i.w[2][l], -p.j.w[2][l]);
      EXPECT_EQ(p.j.v[0][l], 0.0);
      EXPECT_NEAR(p.j.v[1][l] / 0.2, 0.5, 1e-3);
    }
  }
}

// A second sphere of 125 000 times the mass is a plane, whatever its radius, and whether it is rigid (case A)
// or of the same material: one dimensionless problem.
TEST(ChungOoi, SpinningSphereOnHeavySphere) {
  for (const Material& m : {alloy, nylon}) {
    HertzPair plane = on_plane(spinning(m), 2000);
    plane.steps(6000);
    for (const double stiffer : {1000.0, 1.0}) {
      HertzPair p = on_plane(spinning(m), 2000);
      p.wall = false;
      p.i.radius = 0.5;
      p.i.inverse_mass = 1e-3 / m.mass(0.5);
      p.i.x[1] = -0.5;
      p.k.stiffness = test::series(m.contact_modulus(), stiffer * m.contact_modulus());
      p.k.shear_stiffness = test::series(m.contact_shear(), stiffer * m.contact_shear());
      p.dt = hertz_contact_time(p.k.stiffness[0], 0.1 * 0.5 / 0.6, m.mass(0.1), 0.2) / 2000;
      p.steps(6000);
      for (int l = 0; l < 8; ++l) {
        EXPECT_NEAR(p.j.v[1][l] / 0.2, plane.j.v[1][l] / 0.2, 3e-4) << spin_ratio[l];
        EXPECT_NEAR(p.j.v[0][l] / 0.2, plane.j.v[0][l] / 0.2, 1e-3) << spin_ratio[l];
        EXPECT_NEAR(p.j.w[2][l] / 2, plane.j.w[2][l] / 2, 2e-3) << spin_ratio[l];
      }
    }
  }
}

}  // namespace
}  // namespace sph
