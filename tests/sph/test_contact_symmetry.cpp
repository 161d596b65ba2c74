// Every law is exactly odd under the exchange of i and j, and the same in every lane: random contacts with
// zeros of both signs and subnormal values among them, compared bit for bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <random>
#include <string>

#include "contact_fixture.hpp"

namespace sph {
namespace {

using test::Body;
using test::lanes;
using test::Load;
using test::Pair;
using test::V;

constexpr double infinity = std::numeric_limits<double>::infinity();

class Values {
 public:
  explicit Values(std::uint64_t seed) : bits_(seed) {}
  /// Uniform in [low, high).
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(bits_() >> 11) * 0x1p-53);
  }
  /// A quarter of the time an awkward value.
  double any(double scale) {
    constexpr double awkward[] = {0.0, -0.0, 0x1p-1074, -0x1p-1060, 0x1p-1022, -1e-200, 1e-30, 1.0};
    if (bits_() % 4 == 0) return awkward[bits_() % 8];
    return uniform(-scale, scale);
  }
  V any_lanes(double scale) {
    return lanes([&](int) { return any(scale); });
  }
  V positive_lanes(double high) {
    return lanes([&](int) { return uniform(1e-3 * high, high); });
  }
  std::uint64_t next() { return bits_(); }

 private:
  std::mt19937_64 bits_;
};

/// Inputs and answers of the three laws.
struct Case {
  Contact<V> contact{};
  ContactConstants<V> k{};
  V spring[3], roll_spring[3];
  NormalForce<V> normal{};
  V force[3], torque[3];

  template <class Normal>
  void answer() {
    normal = Normal::force(contact, k);
    Coulomb::force(contact, k, normal, spring, force);
    RollingSpring::torque(contact, k, normal, roll_spring, torque);
  }

  template <class F>
  void each_vector(F apply) {
    for (int a = 0; a < 3; ++a)
      for (V* v : {&contact.normal[a], &contact.slip[a], &contact.roll[a], &spring[a], &roll_spring[a],
                   &force[a], &torque[a]})
        apply(*v);
  }
  template <class F>
  void each_scalar(F apply) {
    for (V* v : {&contact.overlap, &contact.separation, &contact.radius, &contact.mass, &contact.dt,
                 &k.stiffness, &k.shear_stiffness, &k.damping, &k.shear_damping, &k.friction,
                 &k.rolling_friction, &k.damping_change, &k.least_force, &k.rolling_damping, &normal.force,
                 &normal.elastic, &normal.shear_stiffness, &normal.shear_change, &normal.dashpot})
      apply(*v);
  }
};

Case random_case(Values& values) {
  Case c;
  c.each_vector([&](V& v) { v = values.any_lanes(2.0); });
  c.each_scalar([&](V& v) { v = values.positive_lanes(3.0); });
  V n2 = V::zero();
  for (const V& n : c.contact.normal) n2 += n * n;
  for (V& n : c.contact.normal) n = n / max(sqrt(n2), V(1e-300));
  c.contact.separation = values.any_lanes(1.0);
  c.contact.overlap = lanes([&](int) { return std::abs(values.any(1e-2)); });
  c.contact.dt = values.positive_lanes(1e-2);
  c.k.friction = values.next() % 4 == 0 ? V::zero() : values.positive_lanes(1.0);
  c.k.least_force = values.next() % 2 == 0 ? V::zero() : V(-infinity);
  return c;
}

std::uint64_t bits(double x) { return std::bit_cast<std::uint64_t>(x); }

/// Counts values that differ: not at all, only in the sign of a zero, or else.
struct Difference {
  int values = 0, zeros = 0, wrong = 0;
  void add(const V& a, const V& b) {
    for (int l = 0; l < V::lanes; ++l) {
      ++values;
      if (bits(a[l]) == bits(b[l])) continue;
      ++(a[l] == 0 && b[l] == 0 ? zeros : wrong);
    }
  }
};

template <class Normal>
Difference exchange(std::uint64_t seed) {
  Values values(seed);
  Difference difference;
  for (int n = 0; n < 5000; ++n) {
    Case c = random_case(values), d = c;
    d.each_vector([](V& v) { v = -v; });
    c.answer<Normal>();
    d.answer<Normal>();
    d.each_vector([](V& v) { v = -v; });
    difference.add(c.normal.force, d.normal.force);
    difference.add(c.normal.shear_change, d.normal.shear_change);
    for (int a = 0; a < 3; ++a) {
      difference.add(c.force[a], d.force[a]);
      difference.add(c.spring[a], d.spring[a]);
      difference.add(c.roll_spring[a], d.roll_spring[a]);
    }
  }
  return difference;
}

TEST(ContactSymmetry, LawsAreOdd) {
  for (const Difference& d : {exchange<LinearNormal>(1), exchange<LinearRate>(2), exchange<HertzNormal>(3)}) {
    EXPECT_EQ(d.wrong, 0) << "of " << d.values;
    // x - x is +0 whichever way round: such a zero has one sign in both orientations. No quantum sees it.
    EXPECT_LT(d.zeros, d.values / 4);
    RecordProperty("zeros of one sign", std::to_string(d.zeros));
  }
}

template <class Normal>
Difference permutation(std::uint64_t seed) {
  Values values(seed);
  Difference difference;
  for (int n = 0; n < 2000; ++n) {
    const int shift = 1 + static_cast<int>(values.next() % 7);
    const auto turned = [=](const V& v) { return lanes([&](int l) { return v[(l + shift) % 8]; }); };
    Case c = random_case(values), d = c;
    d.each_vector([&](V& v) { v = turned(v); });
    d.each_scalar([&](V& v) { v = turned(v); });
    c.answer<Normal>();
    d.answer<Normal>();
    c.each_vector([&](V& v) { v = turned(v); });
    difference.add(turned(c.normal.force), d.normal.force);
    for (int a = 0; a < 3; ++a) {
      difference.add(c.force[a], d.force[a]);
      difference.add(c.spring[a], d.spring[a]);
      difference.add(c.roll_spring[a], d.roll_spring[a]);
    }
  }
  return difference;
}

TEST(ContactSymmetry, LanesAreEqual) {
  for (const Difference& d :
       {permutation<LinearNormal>(4), permutation<LinearRate>(5), permutation<HertzNormal>(6)})
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
