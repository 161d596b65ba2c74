// Random contacts with zeros of both signs and subnormal values among them, compared bit for bit: what a law
// answers from either side, and in any lane.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "contact_fixture.hpp"
#include "sph/laws/contact/law.hpp"

namespace sph::test {

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

/// Inputs and answers of a normal law, friction and rolling resistance.
struct Case {
  Contact<V> contact{};
  ContactConstants<V> k{};
  V spring[3], roll_spring[3], memory[most_history];
  NormalForce<V> normal{};
  V force[3], torque[3], rolling_change = V::zero();

  template <class Normal>
  void answer() {
    normal = normal_force<Normal>(contact, k, memory);
    Coulomb::force(contact, k, normal, spring, force);
    rolling_change = Normal::rolling_change(contact, k, normal, memory);
    RollingSpring::torque(contact, k, normal, rolling_change, roll_spring, torque);
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
    for (V* v : {&contact.overlap,
                 &contact.separation,
                 &contact.radius,
                 &contact.mass,
                 &contact.dt,
                 &k.stiffness,
                 &k.shear_stiffness,
                 &k.damping,
                 &k.shear_damping,
                 &k.friction,
                 &k.rolling_friction,
                 &k.damping_change,
                 &k.least_force,
                 &k.rolling_damping,
                 &normal.force,
                 &normal.elastic,
                 &normal.shear_stiffness,
                 &normal.shear_change,
                 &normal.dashpot,
                 &rolling_change})
      apply(*v);
    for (V& m : memory) apply(m);
  }
  /// As seen from the other side.
  template <class Normal>
  void exchange() {
    each_vector([](V& v) { v = -v; });
    for (std::size_t m = 0; m < Normal::history.size(); ++m)
      if (Normal::history[m] == Parity::odd) memory[m] = -memory[m];
  }
};

inline Case random_case(Values& values) {
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
  c.k.least_force = values.next() % 2 == 0 ? V::zero() : V(-std::numeric_limits<double>::infinity());
  return c;
}

inline std::uint64_t bits(double x) { return std::bit_cast<std::uint64_t>(x); }

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

/// Of a contact from one side and from the other.
template <class Normal>
Difference exchange(std::uint64_t seed) {
  Values values(seed);
  Difference difference;
  for (int n = 0; n < 5000; ++n) {
    Case c = random_case(values), d = c;
    d.exchange<Normal>();
    c.answer<Normal>();
    d.answer<Normal>();
    d.exchange<Normal>();
    difference.add(c.normal.force, d.normal.force);
    difference.add(c.normal.shear_change, d.normal.shear_change);
    difference.add(c.rolling_change, d.rolling_change);
    for (std::size_t m = 0; m < Normal::history.size(); ++m) difference.add(c.memory[m], d.memory[m]);
    for (int a = 0; a < 3; ++a) {
      difference.add(c.force[a], d.force[a]);
      difference.add(c.spring[a], d.spring[a]);
      difference.add(c.roll_spring[a], d.roll_spring[a]);
    }
  }
  return difference;
}

/// Of a contact in one lane and in another.
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
    for (std::size_t m = 0; m < Normal::history.size(); ++m) difference.add(turned(c.memory[m]), d.memory[m]);
    for (int a = 0; a < 3; ++a) {
      difference.add(c.force[a], d.force[a]);
      difference.add(c.spring[a], d.spring[a]);
      difference.add(c.roll_spring[a], d.roll_spring[a]);
    }
  }
  return difference;
}

}  // namespace sph::test
