// Laws of how gas gets through bubbles: what the inertia of fast gas leaves, bubbles that stay connected.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "sph/laws/permeability.hpp"
#include "sph/step/simulation.hpp"

namespace {

using namespace sph;

TEST(Permeability, OfFastGasSolvesForchheimersEquation) {
  Permeability m;
  m.inertial_coefficient = 1.5e8;
  for (const double k : {1e-15, 1e-12, 1e-10})
    for (const double gradient : {1e3, 1e6, 1e8}) {
      const double density = 3,
                   speed = inertial_share(m, k, density, gradient) * k / m.gas_viscosity * gradient;
      const double second = 1.5e8 * std::pow(k, 1.353);
      EXPECT_NEAR((m.gas_viscosity / k * speed + density / second * speed * speed) / gradient, 1, 1e-12);
    }
  EXPECT_EQ(inertial_share(Permeability{}, 1e-12, 3, 1e6), 1);
}

TEST(Permeability, OfConnectedBubblesClosesLater) {
  Permeability m;
  m.law = PermeabilityLaw::percolation;
  m.exponent = 2;
  m.closing_threshold = 0.1;
  EXPECT_EQ(relative_permeability(m, 0.25, false), 0);
  EXPECT_NEAR(relative_permeability(m, 0.25, true), 0.15 * 0.15, 1e-15);
  EXPECT_NEAR(relative_permeability(m, 0.4, false), 0.1 * 0.1, 1e-15);
  EXPECT_EQ(relative_permeability(m, 0.1, true), 0);
}

/// Share of gas of the particles of a foam that has sunk together while bubbles were connected.
double left(const std::vector<std::string>& more) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  std::vector<std::string> all{
      "group.magma.permeability={law=\"percolation\", coefficient=1e-7, exponent=1, threshold=0.3}",
      "domain.surface_pressure=5e4"};
  all.insert(all.end(), more.begin(), more.end());
  Simulation s(comm, read_scene(PEPERITE_ACCURACY_DIR "/degassing.toml", all));
  while (s.global().time < 2) s.step();
  std::array<decomp::ExactSum, 2> sums;
  const Particles& p = s.particles();
  for (std::size_t i = 0; i < p.owned(); ++i) {
    if (s.scene().groups[p.data<Field::group>()[i]].kind != GroupKind::fluid) continue;
    sums[0].add(p.data<Field::void_fraction>()[i]);
    sums[1].add(1);
  }
  decomp::ExactSum::all_reduce(comm, sums);
  return sums[0].value() / sums[1].value();
}

// Where bubbles are no more than the threshold the foam keeps its gas, but for those that have been connected before.
TEST(Permeability, LatchedFoamSinksFurther) {
  const double kept = left({}), latched = left({"group.magma.permeability.closing_threshold=0.1"});
  EXPECT_GT(kept, 0.2);
  EXPECT_LT(latched, kept - 0.05);
}

}  // namespace
