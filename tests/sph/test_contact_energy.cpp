// Contacts never make energy: over a grid of impacts, within each impact, and over closed cycles of load.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "contact_fixture.hpp"
#include "sph/laws/contact/restitution.hpp"
#include "sph/laws/contact/time_step.hpp"

namespace sph {
namespace {

using std::numbers::pi;
using test::lanes;
using test::Pair;
using test::V;

constexpr int steps_of_contact = 200;

/// Eight angles of incidence from 0 to 86 degrees, normal speed 1 m/s, mass 0.01 kg.
template <class Normal>
Pair<Normal> impact(double e, double shear_damping, double friction, double spin, bool wall) {
  constexpr bool hertz = std::is_same_v<Normal, HertzNormal>;
  Pair<Normal> p;
  const double radius = 0.01, mass = 0.01, stiffness = hertz ? 1e7 : 1e5;
  p.wall = wall;
  p.i.radius = p.j.radius = wall ? radius : 2 * radius;
  p.i.inverse_mass = p.j.inverse_mass = wall ? 1 / mass : 0.5 / mass;
  if (!wall) p.i.x[1] = V::zero() - p.i.radius;
  p.j.x[1] = p.j.radius;
  p.j.v[0] = lanes([](int l) { return std::tan(l * 12.3 * pi / 180); });
  p.j.v[1] = -1.0;
  p.j.w[2] = V(spin) / p.j.radius;
  p.j.w[0] = V(0.3 * spin) / p.j.radius;
  if (!wall) p.i.w[1] = V(0.7 * spin) / p.i.radius;
  p.k.stiffness = stiffness;
  p.k.shear_stiffness = hertz ? 0.24 * stiffness : 2.0 / 7 * stiffness;
  p.k.damping = damping_of(Normal::impact, false, e);
  p.k.shear_damping = shear_damping;
  p.k.friction = friction;
  p.dt = (hertz ? hertz_contact_time(stiffness, radius, mass, 1.0) : linear_contact_time(stiffness, mass)) /
         steps_of_contact;
  return p;
}

struct Worst {
  double gain = -1;  ///< of a whole impact, in energies of its normal motion
  double rise = 0;   ///< at any time, counting what the springs hold, from the lowest before
};

template <class Normal>
Worst over_the_grid(double e, double shear_damping) {
  const double unit = 0.5 * 0.01;
  Worst worst;
  for (const bool wall : {true, false})
    for (const double mu : {0.05, 0.1, 0.3, 0.5, 1.0, 3.0})
      for (const double spin : {-20.0, -5.0, -1.0, 0.0, 0.5, 1.0, 2.0, 5.0, 20.0}) {
        auto p = impact<Normal>(e, shear_damping, mu, spin, wall);
        const V start = p.kinetic_energy();
        V lowest = start, rise = V::zero();
        for (int n = 0; n < 3 * steps_of_contact; ++n) {
          const auto before = p;
          p.step();
          const V energy = test::whole_energy(before, p);
          rise = max(rise, energy - lowest);
          lowest = min(lowest, energy);
        }
        const V gain = p.kinetic_energy() - start;
        for (int l = 0; l < V::lanes; ++l) {
          EXPECT_LT(p.contact.overlap[l], 0);
          worst.gain = std::max(worst.gain, gain[l] / unit);
          worst.rise = std::max(worst.rise, rise[l] / unit);
        }
      }
  return worst;
}

// Without any dashpot what is left is the error of the integrator, of second order; with one nothing rises.
TEST(ContactEnergy, ImpactsNeverGain) {
  for (const double shear_damping : {0.0, 0.5, 1.0})
    for (const double e : {1.0, 0.9, 0.5, 0.1}) {
      const Worst linear = over_the_grid<LinearNormal>(e, shear_damping);
      const Worst hertz = over_the_grid<HertzNormal>(e, shear_damping);
      EXPECT_LT(linear.gain, e == 1 ? 1e-4 : 0.0) << e << " " << shear_damping;
      EXPECT_LT(hertz.gain, e == 1 ? 1e-6 : 0.0) << e << " " << shear_damping;
      EXPECT_LT(linear.rise, e == 1 ? 3e-3 : 2e-5) << e << " " << shear_damping;
      EXPECT_LT(hertz.rise, e == 1 ? 2e-4 : 2e-5) << e << " " << shear_damping;
    }
}

// Overlap and tangential displacement go round closed loops, in eight phases to each other: a spring whose
// stiffness fell with the overlap while its force stayed would give energy in half of them (Elata & Berryman
// 1996). Far below Coulomb's limit, where nothing else would take it.
TEST(ContactEnergy, CyclesMakeNone) {
  const double depth = 1e-5, swing = 1e-7;
  Contact<V> c{};
  const ContactConstants<V> k{V(5e10), V(2e10), V(0.0), V(0.0), V(10.0), V(0.0), V(0.0), V(0.0), V(0.0)};
  c.normal[0] = 0, c.normal[1] = 1, c.normal[2] = 0;
  c.radius = 0.01;
  c.mass = 1;
  c.dt = 1;
  for (int a = 0; a < 3; ++a) c.slip[a] = c.roll[a] = V::zero();
  V spring[3] = {V::zero(), V::zero(), V::zero()}, force[3], last = V::zero();
  V given = V::zero(), largest = V::zero();
  constexpr int steps = 2000;
  for (int n = 0; n < 4 * steps; ++n) {
    const double now = 2 * pi * n / steps, before = 2 * pi * (n - 1) / steps;
    const auto at = [&](double t, int l) { return depth * (1 + 0.9 * std::cos(t + l * pi / 4)); };
    c.overlap = lanes([&](int l) { return at(now, l); });
    c.separation = lanes([&](int l) { return at(before, l) - at(now, l); });
    c.slip[0] = swing * (std::sin(now) - std::sin(before));
    const NormalForce<V> normal = HertzNormal::force(c, k);
    Coulomb::force(c, k, normal, spring, force);
    if (n >= steps) given += V(0.5) * (force[0] + last) * c.slip[0];
    last = force[0];
    largest = max(largest, force[0] * V(swing));
  }
  for (int l = 0; l < V::lanes; ++l) EXPECT_LT(given[l], 0) << l << " of " << largest[l];
}

}  // namespace
}  // namespace sph
