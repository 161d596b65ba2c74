// Chung & Ooi 2011 (Granular Matter 13, 643), benchmark tests 1 to 5: one impact each, eight cases a run.
// References: closed forms where there are any, else the solution of the same incremental Mindlin law with
// Coulomb's cap at a far smaller step, and the published curves with the accuracy of reading them off. Tests
// 6 to 8 are in test_contact_spin.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "contact_impact.hpp"
#include "sph/laws/contact/time_step.hpp"

namespace sph {
namespace {

using std::numbers::pi;
using test::HertzPair;
using test::Impact;
using test::Material;
using test::on_plane;

struct Head {
  const char* name;
  bool two_spheres;
  Impact impact;  ///< of each sphere of the two
  double overlap, force, duration;
};
constexpr Material glass{48e9, 0.20, 2800}, limestone{20e9, 0.25, 2500}, aluminium{70e9, 0.30, 2699},
    magnesium{40e9, 0.35, 1800}, alumina{380e9, 0.23, 4000}, iron{100e9, 0.25, 7000};
constexpr Head heads[] = {
    {"1 glass", true, {glass, 0.01, 10}, 274.1127e-6, 10.69689e3, 40.3395e-6},
    {"1 limestone", true, {limestone, 0.01, 10}, 368.3040e-6, 7.10824e3, 54.2011e-6},
    {"2 aluminium", false, {aluminium, 0.1, 0.2}, 49.7172e-6, 11.36986e3, 731.658e-6},
    {"2 magnesium", false, {magnesium, 0.1, 0.2}, 52.1233e-6, 7.23268e3, 767.067e-6},
    {"3 alumina", false, {alumina, 2.5e-3, 3.9}, 8.08881e-6, 0.61535e3, 6.1045e-6},
    {"3 iron", false, {iron, 2.5e-3, 3.9}, 17.1887e-6, 0.50676e3, 12.9721e-6},
};

TEST(ChungOoi, HeadOnElastic) {
  constexpr int steps = 2000;
  for (const Head& h : heads) {
    std::array<Impact, 8> cases;
    cases.fill(h.impact);
    HertzPair p = on_plane(cases, steps);
    double modulus = h.impact.material.contact_modulus(), radius = h.impact.radius;
    double mass = h.impact.material.mass(radius), speed = h.impact.normal_speed;
    if (h.two_spheres) {
      p.wall = false;
      p.i = p.j;
      p.i.x[1] = -p.j.radius;
      p.i.v[1] = speed;
      modulus /= 2, radius /= 2, mass /= 2, speed *= 2;
      p.k.stiffness = modulus;
      p.dt = hertz_contact_time(modulus, radius, mass, speed) / steps;
    }
    const double overlap = hertz_overlap(modulus, radius, mass, speed);
    const double force = 4.0 / 3.0 * modulus * std::sqrt(radius * overlap) * overlap;
    const double duration = hertz_contact_time(modulus, radius, mass, speed);
    p.steps(steps + steps / 10);
    // A step of drift before the first force, a maximum between two steps, an end between two: 1e-5, 1e-3.
    EXPECT_NEAR(p.largest_overlap[0] / overlap, 1, 1e-5) << h.name;
    EXPECT_NEAR(p.largest_force[0] / force, 1, 1e-5) << h.name;
    EXPECT_NEAR(p.steps_in_touch[0] / steps, 1, 1e-3) << h.name;
    EXPECT_NEAR(p.j.v[1][0] / h.impact.normal_speed, 1, 1e-5) << h.name;
    // The table of the benchmark (four digits or more of it).
    EXPECT_NEAR(overlap / h.overlap, 1, 1e-5) << h.name;
    EXPECT_NEAR(force / h.force, 1, 1e-5) << h.name;
    EXPECT_NEAR(duration / h.duration, 1, 1e-5) << h.name;
  }
}

TEST(ChungOoi, Restitution) {
  constexpr double wanted[8] = {0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 0.9, 1.0};
  for (const Material& m : {alumina, iron}) {
    std::array<Impact, 8> cases;
    for (int l = 0; l < 8; ++l) {
      cases[l] = {m, 2.5e-3, 3.9};
      cases[l].material.restitution = wanted[l];
    }
    HertzPair p = on_plane(cases, 1000);
    p.steps(4000);
    for (int l = 0; l < 8; ++l) EXPECT_NEAR(p.j.v[1][l] / 3.9 / wanted[l], 1, 5e-3) << wanted[l];
  }
}

/// 3.9 m/s at an angle to the normal, in test 4.
std::array<Impact, 8> oblique(const std::array<double, 8>& degrees) {
  std::array<Impact, 8> cases;
  for (int l = 0; l < 8; ++l) {
    const double angle = degrees[l] * pi / 180;
    cases[l] = {alumina, 2.5e-3, 3.9 * std::cos(angle), 3.9 * std::sin(angle)};
    cases[l].material.friction = 0.092;
    cases[l].material.restitution = 0.98;
  }
  return cases;
}

TEST(ChungOoi, ObliqueGrossSliding) {
  const std::array<double, 8> degrees{35, 40, 45, 50, 60, 70, 80, 85};
  const auto cases = oblique(degrees);
  HertzPair p = on_plane(cases, 1000);
  p.steps(1200);
  for (int l = 0; l < 8; ++l) {
    const double normal = cases[l].normal_speed, e = p.j.v[1][l] / normal;
    EXPECT_NEAR(e, 0.98, 1e-4);
    const double loss = 0.092 * (1 + e) * normal;  // speed that friction takes: mu times the momentum
    // Below 60 degrees the last few steps of the contact stick.
    EXPECT_NEAR(p.j.v[0][l] / cases[l].tangential_speed, 1 - loss / cases[l].tangential_speed, 4e-6)
        << degrees[l];
    EXPECT_NEAR(p.j.w[2][l] / (-2.5 * loss / 2.5e-3), 1, 4e-6) << degrees[l];
  }
  constexpr double restitution[] = {0.7829, 0.8471, 0.8948, 0.9337, 0.9679},
                   spin[] = {544.2, 456.7, 355.2, 243.0, 123.4};
  constexpr int lane[] = {1, 3, 4, 5, 6};
  for (int n = 0; n < 5; ++n) {
    EXPECT_NEAR(p.j.v[0][lane[n]] / cases[lane[n]].tangential_speed, restitution[n], 1e-4);
    EXPECT_NEAR(-p.j.w[2][lane[n]], spin[n], 0.1);
  }
}

TEST(ChungOoi, ObliqueSticking) {
  constexpr double read_off[] = {0.948, 0.687, 0.624, 0.616, 0.634, 0.684};
  constexpr double mindlin[] = {0.861, 0.711, 0.631, 0.620, 0.638, 0.684};
  constexpr double spin[] = {19, 213, 378, 511, 599, 617};
  const auto cases = oblique({5, 10, 15, 20, 25, 30, 30, 30});
  HertzPair p = on_plane(cases, 2000);
  p.steps(2400);
  for (int l = 0; l < 6; ++l) {
    const double e = p.j.v[0][l] / cases[l].tangential_speed;
    EXPECT_NEAR(e, mindlin[l], 4e-3) << 5 * (l + 1);
    EXPECT_NEAR(e, read_off[l], l == 0 ? 0.1 : 0.03) << 5 * (l + 1);
    EXPECT_NEAR(-p.j.w[2][l], spin[l], 40) << 5 * (l + 1);
  }
}

/// The same law in one dimension and without units, tangential quantities over mu: d'' = -d^(3/2), d'(0) = 1,
/// T' = -kappa (3/2) sqrt(d) s, |T| <= d^(3/2), s' = 7/2 T; 5/2 of the integral of T is omega R / (mu v_n).
double spin_by_one_dimension(double poisson_ratio, double slip) {
  const double kappa = 2 * (1 - poisson_ratio) / (2 - poisson_ratio), h = 2e-5;
  double d = 0, v = 1, s = slip, t = 0, spin = 0;
  for (;;) {
    d += h / 2 * v;
    if (d <= 0) return spin;
    const double root = std::sqrt(d), normal = d * root;
    if (v < 0) t *= std::sqrt(d / (d - h * v));
    t = std::clamp(t - h * kappa * 1.5 * root * s, -normal, normal);
    s += h * 3.5 * t;
    spin += h * 2.5 * t;
    v -= h * normal;
    d += h / 2 * v;
  }
}

// The published plateau is exact. Its points below it (-1.25, -2.52, -4.29 at 1, 2, 3.3) fit neither this law
// nor the same paper's test 4, whose 19, 213 and 378 rad/s are -0.13, -1.51 and -2.73 at 0.95, 1.9 and 2.9:
// the abscissa seems to be another one.
TEST(ChungOoi, ObliqueConstantNormalSpeed) {
  constexpr double ratio[8] = {0.5, 1.0, 2.0, 3.3, 5.0, 7.5, 10, 20};  // v_t / (mu v_n)
  for (const Material& m : {Material{208e9, 0.30, 7850, 0.3}, Material{1e9, 0.40, 1400, 0.3}}) {
    std::array<Impact, 8> cases;
    for (int l = 0; l < 8; ++l) cases[l] = {m, 1e-5, 5, ratio[l] * 0.3 * 5};
    HertzPair p = on_plane(cases, 2000);
    p.steps(2400);
    for (int l = 0; l < 8; ++l) {
      const double spin = p.j.w[2][l] * 1e-5 / (0.3 * 5);
      EXPECT_NEAR(spin, spin_by_one_dimension(m.poisson_ratio, ratio[l]), 3e-3) << ratio[l];
      if (ratio[l] > 7) {
        EXPECT_NEAR(spin, -5, 1e-4) << ratio[l];
      }
    }
  }
}

}  // namespace
}  // namespace sph
