// Flows that heat drives or stiffens: Couette flow that its own friction heats (Nahme 1940), convection between a warm and
// a cold wall (de Vahl Davis 1983); viscosities against published values.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "accuracy/measure.hpp"
#include "accuracy/pinned.hpp"
#include "sph/laws/melt_viscosity.hpp"

namespace {

using sph::Field;

const decomp::Comm& alone() {
  static const decomp::Comm comm(MPI_COMM_SELF);
  return comm;
}

struct Nahme {
  double warming;  ///< b (T - T_0) in the middle over ln(1 + Na/8)
  double stress;   ///< mean of eta du/dy between the rows over the exact one
};

Nahme nahme(double number, std::vector<std::string> overrides) {
  const double b = number, s = std::sqrt(number / 8);
  overrides.push_back("group.melt.viscosity_law.fall=" + std::to_string(b));
  sph::Simulation sim(alone(), sph::read_scene(PEPERITE_ACCURACY_DIR "/nahme.toml", overrides));
  measure::run_until(sim, 1);
  struct Row {
    double y, v, eta;
  };
  std::vector<Row> rows;
  double warmest = 0;
  const sph::Particles& p = sim.particles();
  for (std::size_t i = 0; i < p.owned(); ++i) {
    if (p.data<Field::group>()[i] != 0) continue;
    rows.push_back({sim.scale().metres(p.data<Field::position>()[2 * i + 1]),
                    p.data<Field::velocity>()[2 * i], p.data<Field::viscosity>()[i]});
    warmest = std::max(warmest, p.data<Field::temperature>()[i] - 1);
  }
  std::ranges::sort(rows, {}, &Row::y);
  constexpr std::size_t wide = 12;  // all particles of a row move alike
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i + wide < rows.size(); i += wide, ++count) {
    const Row &low = rows[i], &high = rows[i + wide];
    sum += 2 * low.eta * high.eta / (low.eta + high.eta) * (high.v - low.v) / (high.y - low.y);
  }
  return {b * warmest / std::log(1 + number / 8), sum / count / (std::asinh(s) / (s * std::sqrt(1 + s * s)))};
}

TEST(WarmFlow, NahmeExplicit) {
  const Nahme mild = nahme(8, {});
  EXPECT_NEAR(PINNED(mild.warming), 1, 0.01);
  EXPECT_NEAR(PINNED(mild.stress), 1, 0.01);
}

// A light fluid, so that friction has done its work by the end.
TEST(WarmFlow, NahmeImplicit) {
  const Nahme strong =
      nahme(80, {"terms.implicit_viscosity=true", "terms.viscosity_tolerance=1e-6", "group.melt.density=0.1",
                 "group.melt.sound_speed=30", "group.melt.heat.specific_heat=10"});
  EXPECT_NEAR(PINNED(strong.warming), 1, 0.01);
  EXPECT_NEAR(PINNED(strong.stress), 1, 0.01);
}

/// By moving least squares of first order, weight exp(-r^2 / 2 dx^2).
double velocity_at(const std::vector<measure::Sample>& fluid, double x, double y, int axis, double dx) {
  double m[3][4] = {};
  for (const measure::Sample& q : fluid) {
    const double basis[3] = {1, (q.x[0] - x) / dx, (q.x[1] - y) / dx};
    const double r2 = basis[1] * basis[1] + basis[2] * basis[2];
    if (r2 > 9) continue;
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) m[a][b] += std::exp(-0.5 * r2) * basis[a] * basis[b];
      m[a][3] += std::exp(-0.5 * r2) * basis[a] * q.v[axis];
    }
  }
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      if (a == b) continue;
      const double factor = m[b][a] / m[a][a];
      for (int k = a; k < 4; ++k) m[b][k] -= factor * m[a][k];
    }
  return m[0][3] / m[0][0];
}

// Nu is the mean over the square of u (T - T_m) + 1.
TEST(WarmFlow, DeVahlDavis) {
  sph::Simulation s(alone(), sph::read_scene(PEPERITE_ACCURACY_DIR "/de_vahl_davis.toml", {}));
  double nusselt = 0, across = 0, up = 0;
  constexpr int times = 10;
  for (int k = 0; k < times; ++k) {
    measure::run_until(s, 0.2 + 0.005 * k);
    const sph::Particles& p = s.particles();
    const double* t = p.data<Field::temperature>();
    std::vector<measure::Sample> fluid;
    double flux = 0;
    const std::vector<measure::Sample> all = measure::samples(s);
    for (std::size_t i = 0; i < all.size(); ++i)
      if (!measure::is_wall(s, all[i])) {
        flux += all[i].v[0] * (t[i] - 1.5);
        fluid.push_back(all[i]);
      }
    nusselt += (flux / static_cast<double>(fluid.size()) + 1) / times;
    double u = 0, v = 0;
    for (int n = 2; n <= 98; ++n) {
      u = std::max(u, velocity_at(fluid, 0.5, 0.01 * n, 0, s.scene().start.spacing));
      v = std::max(v, velocity_at(fluid, 0.01 * n, 0.5, 1, s.scene().start.spacing));
    }
    across += u / times;
    up += v / times;
  }
  EXPECT_NEAR(PINNED(nusselt), 2.243, 0.02 * 2.243);
  EXPECT_NEAR(PINNED(across), 16.178, 0.02 * 16.178);
  EXPECT_NEAR(PINNED(up), 19.617, 0.02 * 19.617);
}

TEST(WarmFlow, Viscosities) {
  sph::Group g;
  g.viscosity_law.law = sph::ViscosityLaw::hess_dingwell;
  const auto log10_of = [&](const sph::MeltState& s) { return std::log10(sph::melt_viscosity(g, s)); };
  EXPECT_NEAR(log10_of({.temperature = 1073, .water = 0.001}), 10.3568, 1e-4);
  EXPECT_NEAR(log10_of({.temperature = 1073, .water = 0.01}), 7.3988, 1e-4);
  EXPECT_NEAR(log10_of({.temperature = 1073, .water = 0.04}), 5.1984, 1e-4);
  // MORB with 1 % of water at 1200 C by Giordano et al. (2008).
  g.viscosity_law.law = sph::ViscosityLaw::vogel;
  g.viscosity_law.vogel.a = -4.55;
  g.viscosity_law.vogel.b = 5515.14;
  g.viscosity_law.vogel.c = 489.235;
  EXPECT_NEAR(log10_of({.temperature = 1473.15}), 1.0553, 1e-4);
  EXPECT_TRUE(std::isinf(log10_of({.temperature = 400})));
  g.viscosity_law.most = 1e9;
  EXPECT_DOUBLE_EQ(sph::melt_viscosity(g, {.temperature = 400}), 1e9);
  g.viscosity_law = {};
  g.viscosity = 10;
  g.viscosity_law.crystals = sph::CrystalLaw::einstein_roscoe;
  g.viscosity_law.maximum_packing = 0.6;
  EXPECT_NEAR(sph::melt_viscosity(g, {.crystals = 0.3}), 10 * std::pow(0.5, -2.5), 1e-12);
  g.viscosity_law.crystals = sph::CrystalLaw::none;
  g.viscosity_law.bubbles = sph::BubbleLaw::round;
  EXPECT_NEAR(sph::melt_viscosity(g, {.void_fraction = 0.75}), 40, 1e-12);
  g.viscosity_law.bubbles = sph::BubbleLaw::stretched;
  EXPECT_NEAR(sph::melt_viscosity(g, {.void_fraction = 0.875}), 10.0 / 32, 1e-12);
}

}  // namespace
