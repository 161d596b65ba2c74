// Conduction and gas flow by the temperatures and pressures of the end of the step: that a step solves its equation, with
// fluxes computed here pair by pair; that any tolerance and any step conserve heat and gas; that neither limits the step.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "sph/core/kernels.hpp"
#include "sph/laws/enthalpy.hpp"
#include "sph/laws/eos/bubbly.hpp"
#include "sph/output/monitors.hpp"
#include "sph/step/simulation.hpp"

namespace {

using namespace sph;

constexpr double k = 2, dt = 3, density = 5;
const HeatMaterial magma{2, k, 30, 900, 1000}, rock{2, k / 10, 0, 0, 0};

/// A hot disc of magma that freezes over a range in cold rock: a periodic box of 16 by 16 spacings.
const std::string dyke = R"(dimension = 2
kernel = { h_over_dx = 1 }
[domain]
lower = [0, 0]
upper = [16, 16]
periodic = [true, true]
[[group]]
name = "magma"
kind = "fluid"
density = 5
sound_speed = 10
temperature = 1010
heat = { specific_heat = 2, conductivity = 2, latent_heat = 30, solidus = 900, liquidus = 1000 }
[[group]]
name = "rock"
kind = "fluid"
density = 5
sound_speed = 10
temperature = 300
heat = { specific_heat = 2, conductivity = 0.2 }
[terms]
motion = false
implicit_conduction = true
[start]
spacing = 1
jitter = 0.1
region = [{ group = "rock" }, { group = "magma", shape = "ball", centre = [8, 8], radius = 5 }]
[time]
steps = 100
dt = 3
[[monitor]]
kind = "budget"
)";

Simulation parsed(const std::string& text, const std::vector<std::string>& more = {}) {
  static const decomp::Comm comm(MPI_COMM_SELF);
  return {comm, parse_scene(text, "implicit", more)};
}

/// F of a pair of the box; 0 beyond the kernel.
double conductance(const Simulation& s, std::size_t i, std::size_t j) {
  static const double moment = [] {
    double sum = 0;
    for (int a = -4; a <= 4; ++a)
      for (int b = -4; b <= 4; ++b) {
        const double r = std::hypot(a, b);
        sum -= 0.5 * Quintic::normalisation<2> * Quintic::slope<2>(r) * r;
      }
    return sum;
  }();
  const std::int64_t* x = s.particles().data<Field::position>();
  double square = 0;
  for (std::size_t a = 0; a < 2; ++a) {
    double e = s.scale().metres(x[2 * j + a]) - s.scale().metres(x[2 * i + a]);
    e -= 16 * std::nearbyint(e / 16);
    square += e * e;
  }
  const double r = std::sqrt(square);
  return r > 0 && r < 3 ? -Quintic::normalisation<2> * Quintic::slope<2>(r) / r / moment : 0.0;
}

// The change of enthalpy against the fluxes between the temperatures after the step.
TEST(ImplicitExchange, SolvesTheEquationOfConductionWithFreezing) {
  Simulation s = parsed(dyke, {"terms.exchange_tolerance=1e-10"});
  const Particles& p = s.particles();
  const double *h = p.data<Field::enthalpy>(), *t = p.data<Field::temperature>(), *m = p.data<Field::mass>();
  const auto* group = p.data<Field::group>();
  for (int step = 0; step < 5; ++step) {
    const std::vector<double> before(h, h + p.owned());
    s.step();
    double worst = 0, largest = 0;
    int freezing = 0;
    for (std::size_t i = 0; i < p.owned(); ++i) {
      double gain = 0;
      for (std::size_t j = 0; j < p.owned(); ++j) {
        const double a = group[i] == 0 ? magma.conductivity : rock.conductivity,
                     b = group[j] == 0 ? magma.conductivity : rock.conductivity;
        gain += 2 * (m[i] / density) * (m[j] / density) * 2 * a * b / (a + b) * conductance(s, i, j) *
                (t[j] - t[i]);
      }
      const double change = m[i] * (h[i] - before[i]);
      worst = std::fmax(worst, std::fabs(change - dt * gain));
      largest = std::fmax(largest, std::fabs(change));
      freezing += t[i] > 900 && t[i] < 1000 ? 1 : 0;
      EXPECT_GE(t[i], 300);
      EXPECT_LE(t[i], 1010);
    }
    EXPECT_GT(largest, 20);
    EXPECT_LT(worst / largest, 1e-8);
    EXPECT_GT(freezing, 3);
  }
}

// 240 times what an explicit step could be, and a tolerance that shows in the temperatures.
TEST(ImplicitExchange, ConservesHeatWithAnyTolerance) {
  Simulation s = parsed(dyke, {"terms.exchange_tolerance=1e-3", "time.dt=300"});
  const Monitors monitors(s);
  const double first = monitors.values(s)[1];
  for (int step = 0; step < 200; ++step) s.step();
  EXPECT_NEAR(monitors.values(s)[1] / first, 1, 1e-13);
}

TEST(ImplicitExchange, WantsAStepWhereNothingElseLimitsIt) {
  EXPECT_THROW(parsed(dyke, {"time.dt="}), InputError);
}

/// Bubbly magma whose gas rises where it is at rest otherwise, with a ball in it that is 10,000 times as tight.
const std::string plug = R"(dimension = 2
kernel = { h_over_dx = 1 }
[domain]
lower = [0, 0]
upper = [16, 19]
periodic = [true, false]
gravity = [0, -10]
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
permeability = { law = "power", coefficient = 1e-10, exponent = 1 }
[[group]]
name = "rock"
kind = "fluid"
eos = "bubbly"
density = 1000
bulk_modulus = 1e10
gas_content = 2e-3
gas_rt = 5e5
solubility_pressure = 1e10
solubility_exponent = 2
permeability = { law = "power", coefficient = 1e-14, exponent = 1 }
[[group]]
name = "floor"
kind = "wall"
[terms]
motion = false
gas_escape = false
implicit_gas_flow = true
[start]
spacing = 1
jitter = 0.1
pressure = "hydrostatic"
layer = [{ group = "magma", top = 18, pressure = 3e5 }]
region = [{ group = "floor" }, { group = "magma", shape = "box", lower = [0, 3], upper = [16, 18] },
          { group = "rock", shape = "ball", centre = [8, 9], radius = 3 },
          { group = "none", shape = "box", lower = [0, 18], upper = [16, 19] }]
[time]
steps = 100
[[monitor]]
kind = "budget"
)";

TEST(ImplicitExchange, ConservesGasInStepsBeyondTheExplicitLimit) {
  Simulation s = parsed(plug);
  const Monitors monitors(s);
  const double gas = monitors.values(s)[1];
  const double explicit_step = parsed(plug, {"terms.implicit_gas_flow=false"}).global().dt;
  double longest = 0;
  for (int step = 0; step < 100; ++step) {
    s.step();
    longest = std::fmax(longest, s.global().dt);
  }
  EXPECT_GT(longest, 10 * explicit_step);
  EXPECT_NEAR(monitors.values(s)[1] / gas, 1, 1e-13);
}

}  // namespace
