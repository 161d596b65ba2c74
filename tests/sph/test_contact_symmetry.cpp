// Every law is exactly odd under the exchange of i and j, and the same in every lane: random contacts with
// zeros of both signs and subnormal values among them, compared bit for bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>

#include "contact_symmetry.hpp"

namespace sph {
namespace {

using test::Body;
using test::Case;
using test::Difference;
using test::Pair;
using test::random_case;
using test::V;
using test::Values;

TEST(ContactSymmetry, LawsAreOdd) {
  for (const Difference& d :
       {test::exchange<LinearNormal>(1), test::exchange<LinearRate>(2), test::exchange<HertzNormal>(3)}) {
    EXPECT_EQ(d.wrong, 0) << "of " << d.values;
    // x - x is +0 whichever way round: such a zero has one sign in both orientations. No quantum sees it.
    EXPECT_LT(d.zeros, d.values / 4);
    RecordProperty("zeros of one sign", std::to_string(d.zeros));
  }
}

TEST(ContactSymmetry, LanesAreEqual) {
  for (const Difference& d : {test::permutation<LinearNormal>(4), test::permutation<LinearRate>(5),
                              test::permutation<HertzNormal>(6)})
    EXPECT_EQ(d.wrong + d.zeros, 0) << "of " << d.values;
}

// Two bodies, whole: what acts on one of them is the same bits whether it is i or j.
TEST(ContactSymmetry, BodiesAreExchangeable) {
  using P = Pair<HertzNormal, Coulomb, RollingSpring>;
  Values values(7);
  Difference difference;
  for (int n = 0; n < 2000; ++n) {
    P p;
    for (Body* b : {&p.i, &p.j}) {
      b->radius = values.positive_lanes(1.0);
      b->inverse_mass = values.positive_lanes(5.0);
      for (int a = 0; a < 3; ++a) {
        b->x[a] = values.any_lanes(1.0);
        b->v[a] = values.any_lanes(1.0);
        b->w[a] = values.any_lanes(1.0);
      }
    }
    p.j.x[0] = p.i.x[0] + V(0.1);  // never at one point
    p.k = {V(100.0), V(80.0), V(0.3), V(0.5), V(0.4), V(0.1), V(0.3), V(-0.01), V(0.0)};
    P q = p;
    std::swap(q.i, q.j);
    p.steps(3);
    q.steps(3);
    for (int a = 0; a < 3; ++a) {
      difference.add(p.i.v[a], q.j.v[a]);
      difference.add(p.j.v[a], q.i.v[a]);
      difference.add(p.i.w[a], q.j.w[a]);
      difference.add(p.j.w[a], q.i.w[a]);
      difference.add(p.spring[a], -q.spring[a]);
      difference.add(p.roll_spring[a], -q.roll_spring[a]);
    }
  }
  EXPECT_EQ(difference.wrong, 0) << "of " << difference.values;
}

TEST(ContactSymmetry, NanComesThrough) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Values values(8);
  const auto answer = [&](auto spoil) {
    Case c = random_case(values);
    spoil(c);
    c.answer<HertzNormal>();
    return c;
  };
  const Case separation = answer([&](Case& c) { c.contact.separation = nan; });
  const Case slip = answer([&](Case& c) { c.contact.slip[1] = nan; });
  const Case roll = answer([&](Case& c) { c.contact.roll[2] = nan; });
  const Case history = answer([&](Case& c) { c.spring[0] = nan; });
  for (int l = 0; l < V::lanes; ++l) {
    EXPECT_TRUE(std::isnan(separation.normal.force[l]) && std::isnan(separation.force[0][l]));
    EXPECT_TRUE(std::isnan(slip.force[1][l]));
    EXPECT_TRUE(std::isnan(roll.roll_spring[2][l]));
    EXPECT_TRUE(std::isnan(history.force[0][l]) && std::isnan(history.spring[0][l]));
  }
}

}  // namespace
}  // namespace sph
