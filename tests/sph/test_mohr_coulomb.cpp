// Strength at a point: returns to the planes of Mohr-Coulomb against projections found by trying all planes.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <vector>

#include "sph/laws/mohr_coulomb.hpp"
#include "sph/laws/principal_stress.hpp"
#include "sph/laws/yielding.hpp"

namespace {

using sph::StrengthConstants, sph::StressRegion, sph::return_to_mohr_coulomb;
using Vector = Eigen::Vector3d;

constexpr double K = 1e10, G = 6e9, degree = std::numbers::pi / 180;

StrengthConstants constants(double c, double phi, double psi, double tension = 1e300) {
  return {std::sin(phi * degree), std::cos(phi * degree), std::sin(psi * degree), c, tension, K, G, false};
}
std::array<double, 3> sorted(std::array<double, 3> s) {
  std::sort(s.begin(), s.end(), std::greater<>());
  return s;
}
Vector vector(const std::array<double, 3>& s) { return {s[0], s[1], s[2]}; }

Eigen::Matrix3d stiffness() {
  return Eigen::Matrix3d::Constant(K - 2 * G / 3) + 2 * G * Eigen::Matrix3d::Identity();
}

/// Each pair of axes in both orders, and each axis in tension.
struct Plane {
  Vector normal, flow;
  double limit;
};
std::vector<Plane> planes(const StrengthConstants& k) {
  std::vector<Plane> out;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (i == j) continue;
      Vector n = Vector::Zero(), m = n;
      n[i] = 1 + k.sin_friction, n[j] = k.sin_friction - 1;
      m[i] = 1 + k.sin_dilatancy, m[j] = k.sin_dilatancy - 1;
      out.push_back({n, m, 2 * k.cohesion * k.cos_friction});
    }
    Vector e = Vector::Zero();
    e[i] = 1;
    out.push_back({e, e, std::min(k.tensile_strength, sph::cone_tip(k))});
  }
  return out;
}

/// All sets of at most three of them.
template <class Try>
void for_sets(std::size_t n, Try attempt) {
  for (std::size_t a = 0; a < n; ++a) {
    attempt(std::vector{a});
    for (std::size_t b = a + 1; b < n; ++b) {
      attempt(std::vector{a, b});
      for (std::size_t c = b + 1; c < n; ++c) attempt(std::vector{a, b, c});
    }
  }
}

/// The point of what all planes allow that is nearest in the metric of the elastic energy.
Vector nearest(const std::vector<Plane>& all, const Vector& trial) {
  const Eigen::Matrix3d c = stiffness(), compliance = c.inverse();
  const double size = trial.cwiseAbs().maxCoeff();
  double least = 1e300;
  Vector best = trial;
  for_sets(all.size(), [&](const std::vector<std::size_t>& set) {
    Eigen::MatrixXd n(set.size(), 3);
    Eigen::VectorXd f(set.size());
    for (std::size_t k = 0; k < set.size(); ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      n.row(row) = all[set[k]].normal.transpose();
      f[row] = all[set[k]].normal.dot(trial) - all[set[k]].limit;
    }
    const Vector s = trial - c * n.transpose() * (n * c * n.transpose()).fullPivLu().solve(f);
    for (const Plane& p : all)
      if (!(p.normal.dot(s) - p.limit <= 1e-11 * size)) return;
    const double away = (s - trial).dot(compliance * (s - trial));
    if (away < least) least = away, best = s;
  });
  return best;
}

/// How far the plastic strain is from what the planes that a stress lies on can flow, none of them backwards.
double misfit(const std::vector<Plane>& all, const Vector& trial, const Vector& end) {
  const double size = trial.cwiseAbs().maxCoeff();
  const Vector strain = stiffness().inverse() * (trial - end) * 2 * G;
  std::vector<Plane> on;
  for (const Plane& p : all)
    if (p.normal.dot(end) - p.limit >= -1e-9 * size) on.push_back(p);
  double least = 1e300;
  for_sets(on.size(), [&](const std::vector<std::size_t>& set) {
    Eigen::MatrixXd m(3, set.size());
    for (std::size_t k = 0; k < set.size(); ++k) m.col(static_cast<Eigen::Index>(k)) = on[set[k]].flow;
    const Eigen::VectorXd amount = m.colPivHouseholderQr().solve(strain);
    if (amount.minCoeff() >= -1e-9 * size) least = std::min(least, (m * amount - strain).norm());
  });
  return least / size;
}

std::array<double, 3> random_state(std::mt19937& random, double spread) {
  std::normal_distribution<double> normal(0, spread);
  const double mean = normal(random);
  return sorted({mean + normal(random), mean + normal(random), mean + normal(random)});
}

TEST(MohrCoulomb, IsTheNearestStressOfAll) {
  std::mt19937 random(1);
  std::map<StressRegion, int> seen;
  double worst_surface = 0, worst = 0;
  for (int n = 0; n < 20000; ++n) {
    const double phi = std::array{0.0, 20.0, 30.0, 45.0}[n % 4];
    const double tension = std::array{3e5, 1e5, 2e6, 0.0, 1e300}[n % 5];
    const StrengthConstants k = constants(1e6, phi, phi, tension);
    const std::array<double, 3> trial = random_state(random, n % 3 == 0 ? 2e6 : 5e6);
    const auto end = return_to_mohr_coulomb(k, trial);
    ++seen[end.region];
    const double size = vector(trial).cwiseAbs().maxCoeff();
    const Vector expected =
        end.region == StressRegion::elastic ? vector(trial) : nearest(planes(k), vector(trial));
    worst = std::max(worst, (vector(end.stress) - expected).cwiseAbs().maxCoeff() / size);
    worst_surface = std::max(worst_surface, sph::beyond_mohr_coulomb(k, end.stress) / size);
    ASSERT_EQ(return_to_mohr_coulomb(k, end.stress).region, StressRegion::elastic) << n;
    ASSERT_EQ(return_to_mohr_coulomb(k, end.stress).stress, end.stress) << n;
  }
  std::printf("Mohr-Coulomb, 20,000 states: %.1e from the nearest, %.1e beyond the surface\n", worst,
              worst_surface);
  EXPECT_LE(worst, 1e-10);
  EXPECT_LE(worst_surface, 1e-12);
  for (int region = 0; region < 10; ++region)
    EXPECT_GE(seen[static_cast<StressRegion>(region)], 50) << "region " << region;
}

TEST(MohrCoulomb, FlowsAsItsDilatancySays) {
  std::mt19937 random(2);
  std::map<StressRegion, int> seen;
  double worst = 0;
  for (int n = 0; n < 20000; ++n) {
    const double phi = 10.0 + n % 30, psi = std::array{0.0, 5.0, 10.0}[n % 3];
    const double tension = std::array{3e5, 1e5, 2e6, 1e300}[n % 4];
    const StrengthConstants k = constants(1e6, phi, psi, tension);
    const std::array<double, 3> trial = random_state(random, 5e6);
    const auto end = return_to_mohr_coulomb(k, trial);
    ++seen[end.region];
    if (end.region == StressRegion::elastic) continue;
    worst = std::max(worst, misfit(planes(k), vector(trial), vector(end.stress)));
    EXPECT_GE(end.plastic_volume, 0);
    const Vector lost = vector(trial) - vector(end.stress);
    EXPECT_NEAR(end.plastic_volume, lost.sum() / (3 * K), 1e-9 * lost.norm() / K);
    const Vector strain = stiffness().inverse() * lost;
    EXPECT_NEAR(end.plastic_shear, strain.maxCoeff() - strain.minCoeff(), 1e-9 * lost.norm() / G);
    const bool shears_alone = end.region <= StressRegion::edge_23;
    const bool cut = end.region >= StressRegion::tension;
    if (shears_alone) {
      EXPECT_EQ(end.opening, 0);
    } else if (cut && psi == 0) {
      EXPECT_NEAR(end.opening, end.plastic_volume, 1e-9 * lost.norm() / K);
    }
    EXPECT_LE(end.opening, end.plastic_volume + 1e-9 * lost.norm() / K);
    // The energy that the return takes.
    EXPECT_GE(strain.dot(vector(trial) + vector(end.stress)), 0) << n;
    ASSERT_EQ(return_to_mohr_coulomb(k, end.stress).stress, end.stress) << n;
  }
  EXPECT_LE(worst, 1e-9);
  for (int region = 0; region < 10; ++region)
    EXPECT_GE(seen[static_cast<StressRegion>(region)], 50) << "region " << region;
}

TEST(MohrCoulomb, WhatIsNotFiniteStays) {
  const StrengthConstants k = constants(1e6, 30, 0, 1e5);
  EXPECT_TRUE(std::isnan(return_to_mohr_coulomb(k, {NAN, 0, -1e9}).stress[0]));
  EXPECT_EQ(return_to_mohr_coulomb(k, {INFINITY, 0, -1e9}).stress[0], INFINITY);
}

sph::Group rock(const sph::Strength& strength) {
  sph::Group g;
  g.kind = sph::GroupKind::solid;
  g.density = 2000;
  g.eos.bulk_modulus = K;
  g.solid.shear_modulus = G;
  g.solid.strength = strength;
  return g;
}

/// Greatest compression by `strain` in steps, at a lateral pressure that Newton's method holds. Of the stresses xx and
/// yy; zz is the other side (in the plane it does not strain).
double compressed(const sph::Yielding& rock, int dim, double side, double strain) {
  std::array<double, 6> s{};
  double p = side, top = 0;
  for (int step = 0; step < 400; ++step) {
    double lateral = 0;
    std::array<double, 6> end{};
    double end_p = 0;
    for (int iteration = 0; iteration < 200; ++iteration) {
      const Vector e{lateral, -strain / 400, dim == 2 ? 0.0 : lateral};
      end = s;
      const double third = e.sum() / 3;
      for (int k = 0; k < dim; ++k) end[static_cast<std::size_t>(k)] += 2 * G * (e[k] - third);
      const auto yielded = rock.bring_back(end.data(), p - K * e.sum(), 0);
      end_p = yielded.yields ? yielded.pressure : p - K * e.sum();
      const double error = end[0] - end_p + side;
      if (std::abs(error) < 1e-3) break;
      lateral -= error / (2 * (K + G));
    }
    s = end;
    p = end_p;
    top = std::max(top, p - s[1]);
  }
  return top;
}

// s1 = s3 N + 2 c sqrt(N), N = (1 + sin phi) / (1 - sin phi)
TEST(Yielding, TriaxialStrength) {
  sph::Strength s;
  for (const sph::StrengthLaw law : {sph::StrengthLaw::mohr_coulomb, sph::StrengthLaw::drucker_prager}) {
    s.law = law;
    s.cohesion = 1e6, s.friction_angle = 30;
    EXPECT_NEAR(compressed({rock(s), 3, 1}, 3, 0, 2e-3) / 1e6, 3.4641016, 3.5e-6);
    EXPECT_NEAR(compressed({rock(s), 3, 1}, 3, 1e6, 2e-3) / 1e6, 6.4641016, 6.5e-6);
    s.cohesion = 5e6, s.friction_angle = 35;
    EXPECT_NEAR(compressed({rock(s), 3, 1}, 3, 1e7, 8e-3) / 1e6, 56.111505, 5.6e-5);
  }
}

// The third axis, which does not strain, is in between and has no part in Mohr-Coulomb; the cone is fitted to that where
// it flows as it yields.
TEST(Yielding, PlaneStrainStrength) {
  sph::Strength s;
  s.cohesion = 1e6, s.friction_angle = 30;
  EXPECT_NEAR(compressed({rock(s), 2, 1}, 2, 1e6, 2e-3) / 1e6, 6.4641016, 6.5e-6);
  s.law = sph::StrengthLaw::drucker_prager;
  s.dilatancy_angle = 30;
  EXPECT_NEAR(compressed({rock(s), 2, 1}, 2, 1e6, 2e-2) / 1e6, 6.4641016, 6.5e-3);
}

sph::SymmetricTensor turned(const sph::SymmetricTensor& t, const Eigen::Matrix3d& q) {
  Eigen::Matrix3d m;
  m << t[0], t[3], t[4], t[3], t[1], t[5], t[4], t[5], t[2];
  m = (q * m * q.transpose()).eval();
  return {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2), m(1, 2)};
}

TEST(Yielding, KnowsNoDirection) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0, 4e6);
  sph::Strength strength;
  strength.cohesion = 1e6, strength.friction_angle = 25, strength.dilatancy_angle = 5;
  strength.tensile_strength = 4e5;
  int yielded = 0;
  for (int n = 0; n < 3000; ++n) {
    strength.law = n % 2 == 0 ? sph::StrengthLaw::mohr_coulomb : sph::StrengthLaw::drucker_prager;
    const sph::Yielding law(rock(strength), 3, 1);
    sph::SymmetricTensor s{normal(random), normal(random), 0, normal(random), normal(random), normal(random)};
    s[2] = -(s[0] + s[1]);
    const double p = normal(random);
    const Eigen::Matrix3d q =
        n % 3 == 0 ? Eigen::PermutationMatrix<3>(Eigen::Vector3i(1, 2, 0)).toDenseMatrix().cast<double>()
                   : Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
                         .normalized()
                         .toRotationMatrix();
    sph::SymmetricTensor other = turned(s, q), end = s;
    const auto a = law.bring_back(end.data(), p, 0), b = law.bring_back(other.data(), p, 0);
    EXPECT_EQ(a.yields, b.yields);
    if (!a.yields) {
      EXPECT_EQ(end, s);
      continue;
    }
    ++yielded;
    EXPECT_NEAR(a.pressure, b.pressure, 1e-12 * 1e7);
    const sph::SymmetricTensor same = turned(end, q);
    for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(same[k], other[k], 1e-12 * 1e7);
    EXPECT_NEAR((end[0] + end[1]) + end[2], 0, 1e-12 * 1e7);
    sph::SymmetricTensor again = end;  // the axes are found anew, so it is the same but for rounding
    const auto twice = law.bring_back(again.data(), a.pressure, 0);
    EXPECT_NEAR(twice.pressure, a.pressure, 1e-12 * 1e7);
    for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(again[k], end[k], 1e-12 * 1e7);
  }
  EXPECT_GT(yielded, 2000);
}

// A band one spacing wide that shears until only what is residual is left takes G_f per area, whatever the spacing.
TEST(Yielding, SoftensByTheFractureEnergy) {
  sph::Strength strength;
  strength.cohesion = 1e6, strength.friction_angle = 30, strength.residual_cohesion = 2e5;
  strength.fracture_energy = 1e4;
  for (const double dx : {0.1, 0.5, 2.0}) {
    const sph::Yielding law(rock(strength), 2, dx);
    double taken = 0, before = 0, gamma = 0;
    std::array<double, 3> s{};
    const double p = 1e6;
    while (gamma < 1.01 * law.softening_shear()) {
      s[2] += G * law.softening_shear() / 4000;
      const auto end = law.bring_back(s.data(), p, gamma);
      if (!end.yields) continue;
      const double tau = law.constants(gamma).cohesion * law.constants(gamma).cos_friction;
      EXPECT_NEAR(s[2], tau + p * law.constants(gamma).sin_friction, 1e-6 * tau);
      taken += (tau - 2e5 * law.constants(0).cos_friction) * end.plastic_shear;
      gamma += end.plastic_shear;
      before = tau;
    }
    EXPECT_NEAR(before, 2e5 * law.constants(0).cos_friction, 1);
    EXPECT_NEAR(taken * dx / 1e4, 1, 2e-3);
    EXPECT_NEAR(law.constants(10).cohesion, 2e5, 1e-6);
  }
}

TEST(PrincipalAxes, OfAnyTensor) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal(0, 1);
  for (int n = 0; n < 5000; ++n) {
    sph::SymmetricTensor t{};
    for (std::size_t k = 0; k < 6; ++k) t[k] = n % 4 == 0 && k > 3 ? 0.0 : normal(random);
    if (n % 7 == 0) t = {1, 1 + 1e-14 * normal(random), 1, 1e-15 * normal(random), 0, 1e-9 * normal(random)};
    const sph::PrincipalAxes p = sph::principal_axes(t);
    EXPECT_GE(p.values[0], p.values[1]);
    EXPECT_GE(p.values[1], p.values[2]);
    const sph::SymmetricTensor back = sph::tensor_of(p);
    double size = 0;
    for (double x : t) size = std::max(size, std::abs(x));
    for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(back[k], t[k], 4e-15 * size);
  }
}

}  // namespace
