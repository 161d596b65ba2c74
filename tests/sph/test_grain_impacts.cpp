// Chung & Ooi 2011 (Granular Matter 13, 643), one impact of each of the eight tests as a whole run: the pair
// drifts along x while it touches, so that its contact crosses the cuts with its history; a drift changes
// nothing. The laws alone are tested in test_contact_*.cpp; the references are theirs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "grain_fixture.hpp"
#include "sph/laws/contact/time_step.hpp"

namespace sph {
namespace {

using test::grain;
using test::GrainNow;
using test::StartGrain;

struct Body {
  double young_modulus, poisson_ratio, density, radius;
  [[nodiscard]] double modulus() const { return young_modulus / (1 - poisson_ratio * poisson_ratio); }
  [[nodiscard]] double mass() const {
    return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius * density;
  }
};

/// Speeds and spins of the ball; friction acts in t, and the spin is about t x n.
struct Impact {
  const char* name;
  Body ball, other;  ///< other.radius 0: a plane
  double friction, restitution;
  double normal, tangential, spin;  ///< before
  double other_normal, other_spin;
  double normal_out, tangential_out, spin_out, tolerance;
  double overlap = 0;  ///< the largest, where there is a reference [m]
};

Body plane(Body like) {
  like.young_modulus *= 1e6;
  like.radius = 0;
  return like;
}

Body heavy(Body like) {
  like.young_modulus *= 1000;
  like.density *= 1000;
  like.radius *= 5;
  return like;
}

constexpr Body glass{48e9, 0.20, 2800, 0.01}, aluminium{70e9, 0.30, 2699, 0.1},
    alumina{380e9, 0.23, 4000, 2.5e-3}, steel{208e9, 0.30, 7850, 1e-5}, alloy{70e9, 0.33, 2700, 0.1};

std::vector<Impact> impacts() {
  const double angle = 50 * std::numbers::pi / 180;
  const double vn = 3.9 * std::cos(angle), vt = 3.9 * std::sin(angle);
  return {
      {"1", glass, glass, 0, 1, 10, 0, 0, 10, 0, 10, 0, 0, 1e-3, 274.1127e-6},
      {"2", aluminium, plane(aluminium), 0, 1, 0.2, 0, 0, 0, 0, 0.2, 0, 0, 1e-3, 49.7172e-6},
      {"3", alumina, plane(alumina), 0, 0.6, 3.9, 0, 0, 0, 0, 0.6 * 3.9, 0, 0, 5e-3},
      {"4", alumina, plane(alumina), 0.092, 0.98, vn, vt, 0, 0, 0, 0.98 * vn, 0.8471 * vt, -456.7, 2e-3},
      {"5", steel, plane(steel), 0.3, 1, 5, 15, 0, 0, 0, 5, 12, -7.5e5, 2e-3},
      {"6", alloy, plane(alloy), 0.4, 0.5, 0.2, 0, 20, 0, 0, 0.1, -0.12, 17, 5e-3},
      {"7", alloy, alloy, 0.4, 0.5, 0.2, 0, 20, 0.2, -20, 0.1, 0, 20, 5e-3},
      {"8", alloy, heavy(alloy), 0.4, 0.5, 0.2, 0, 20, 0, 0, 0.1, -0.12, 17, 5e-3},
  };
}

struct Case {
  Impact impact;
  Scene scene;
  std::vector<StartGrain> grains;
  std::size_t n, t, s;  ///< axes: s = t x n
  std::int64_t steps;
};

Case case_of(const Impact& m) {
  const bool two = m.other.radius > 0;
  Case c{m, {}, {}, two ? 0U : 2U, two ? 2U : 1U, two ? 1U : 0U, 0};
  const double largest = std::max(m.ball.radius, m.other.radius);
  const double modulus = 1 / (1 / m.ball.modulus() + 1 / m.other.modulus());
  const double radius =
      two ? m.ball.radius * m.other.radius / (m.ball.radius + m.other.radius) : m.ball.radius;
  const double mass = two ? 1 / (1 / m.ball.mass() + 1 / m.other.mass()) : m.ball.mass();
  const double touch = hertz_contact_time(modulus, radius, mass, m.normal + m.other_normal);
  constexpr int steps_in_touch = 600;
  const double dt = touch / steps_in_touch, drift = 3 * largest / touch;
  c.steps = 1000;

  std::ostringstream toml;
  toml.precision(17);
  const auto material = [&](const char* name, const Body& b, double radius_of) {
    toml << "[[group]]\nname = \"" << name << "\"\nkind = \"grain\"\nyoung_modulus = " << b.young_modulus
         << "\npoisson_ratio = " << b.poisson_ratio << "\nrestitution = " << m.restitution
         << "\nfriction = " << m.friction << '\n';
    if (radius_of > 0) toml << "density = " << b.density << "\ndiameter = " << 2 * radius_of << '\n';
  };
  toml << "dimension = 3\n[domain]\nlower = [" << -13 * largest << ", " << -5 * largest << ", "
       << -5 * largest << "]\nupper = [" << 13 * largest << ", " << 5 * largest << ", " << 5 * largest
       << "]\n[contact]\nlaw = \"hertz\"\n";
  material("ball", m.ball, m.ball.radius);
  material("other", m.other, m.other.radius);
  if (!two)
    toml << "[[wall]]\nname = \"floor\"\nmaterial = \"other\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n"
         << "velocity = [" << drift << ", 0, 0]\n";
  toml << "[start]\nfile = \"set later\"\n[time]\ndt = " << dt << "\nsteps = 1\n"
       << "[decomposition]\nbalance = \"fixed\"\nrebuild_every = 5\n";
  c.scene = parse_scene(toml.str(), "impact", {});

  StartGrain ball{"ball", {-1.5 * largest, 0, 0}, {drift, 0, 0}, {}, m.ball.radius};
  ball.x[c.n] += m.ball.radius + 2 * dt * m.normal;
  ball.v[c.n] -= m.normal;
  ball.v[c.t] += m.tangential;
  ball.w[c.s] += m.spin;
  c.grains.push_back(ball);
  if (two) {
    StartGrain other{"other", {-1.5 * largest, 0, 0}, {drift, 0, 0}, {}, m.other.radius};
    other.x[c.n] -= m.other.radius + 2 * dt * m.other_normal;
    other.v[c.n] += m.other_normal;
    other.w[c.s] += m.other_spin;
    c.grains.push_back(other);
  }
  return c;
}

TEST(GrainImpacts, ChungOoi) {
  const decomp::Comm one(MPI_COMM_SELF), all(MPI_COMM_WORLD);
  for (const Impact& m : impacts()) {
    Case c = case_of(m);
    const test::StartFile file(all, c.grains);
    c.scene.start.file = file.path();
    Simulation alone(one, c.scene);
    double overlap = 0;
    for (std::int64_t k = 0; k < c.steps; ++k) {
      const GrainNow ball = grain(alone, 0);
      const double other = c.grains.size() > 1 ? grain(alone, 1).x[c.n] : 0;
      overlap = std::max(overlap, m.ball.radius + m.other.radius - (ball.x[c.n] - other));
      alone.step();
    }
    // The contact began once, ended once, and in between it went through rebuilds.
    const bool rough = m.friction > 0;
    if (rough) {
      EXPECT_EQ(alone.grains()->pairs().counters().created, 1) << m.name;
      EXPECT_EQ(alone.grains()->pairs().counters().ended, 1) << m.name;
      EXPECT_GE(alone.grains()->pairs().counters().carried, 100) << m.name;
    }
    const GrainNow ball = grain(alone, 0);
    const double along = c.n == 0 ? c.grains[0].v[0] + m.normal : 0;  // the drift
    EXPECT_NEAR(ball.v[c.n] - along, m.normal_out, m.tolerance * m.normal_out) << m.name;
    EXPECT_NEAR(ball.v[c.t], m.tangential_out, m.tolerance * std::max(m.normal, m.tangential)) << m.name;
    EXPECT_NEAR(ball.w[c.s], m.spin_out, m.tolerance * std::max(std::fabs(m.spin_out), 1e-9)) << m.name;
    if (m.overlap > 0) {
      EXPECT_NEAR(overlap / m.overlap, 1, 1e-3) << m.name;
    }

    // Two ranks divide the way in the middle; random cuts divide it anywhere, between three.
    c.scene.decomposition.cuts = all.size() == 2 ? CutRule::fixed : CutRule::chaos;
    Simulation shared(all, c.scene);
    std::int64_t straddles = 0;
    for (std::int64_t k = 0; k < c.steps; ++k) {
      shared.step();
      straddles += shared.grains()->pairs().lists().boundary().empty() ? 0 : 1;
    }
    EXPECT_EQ(shared.fingerprint(), alone.fingerprint()) << m.name;
    if (all.size() == 1) continue;
    EXPECT_GT(all.sum(shared.distribution().migrated()), 0) << m.name;
    const std::int64_t across = all.sum(straddles);
    if (c.grains.size() > 1) {
      EXPECT_GT(across, 0) << m.name;
    }
  }
}

}  // namespace
}  // namespace sph
