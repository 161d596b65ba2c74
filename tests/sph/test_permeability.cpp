// Laws of how gas gets through bubbles: what the inertia of fast gas leaves, bubbles that stay connected.
#include <gtest/gtest.h>

#include <algorithm>
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
      const double density = 3, speed = inertial_share(m, k, density, gradient) * k / m.gas_viscosity * gradient;
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

/// Least share of gas after a column of magma, 45 % gas at first, has lost what its bubbles let go.
double least_left(const std::vector<std::string>& more) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  Simulation s(comm, parse_scene(R"(kernel = { h_over_dx = 1 }
[domain]
lower = [0, 0]
upper = [12, 12]
periodic = [true, false]
surface_pressure = 1e5
[[group]]
name = "magma"
kind = "fluid"
eos = "bubbly"
density = 1000
bulk_modulus = 1e10
gas_content = 2e-3
gas_rt = 5e5
solubility_pressure = 1e10
solubility_exponent = 2
permeability = { law = "percolation", coefficient = 1e-7 }
[[group]]
name = "floor"
kind = "wall"
gas_pressure = -0.9e5
[terms]
motion = false
[start]
spacing = 1
lower = [0, 0]
upper = [12, 12]
region = [{ group = "floor" }, { group = "magma", shape = "box", lower = [0, 3], upper = [12, 9] }]
[time]
steps = 1
)",
                                 "column", more));
  for (int k = 0; k < 400; ++k) s.step();
  double least = -1;
  const Particles& p = s.particles();
  for (std::size_t i = 0; i < p.owned(); ++i)
    if (s.scene().groups[p.data<Field::group>()[i]].kind == GroupKind::fluid)
      least = std::max(least, -p.data<Field::gas_content>()[i]);
  comm.max(std::span(&least, 1));
  return -least;
}

// The volume stays: what is left of the gas goes with its pressure, not its share. So a bubble's share is looked at by
// what is let go at all.
TEST(Permeability, LatchedBubblesLoseMore) {
  EXPECT_LT(least_left({"group.magma.permeability.closing_threshold=0.1"}), 0.9 * least_left({}));
}

}  // namespace
