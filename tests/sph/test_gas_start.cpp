// A gas begins with half a kick (Simulation::kick_half_a_step), which guards nothing that a step does not.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "sph/core/error.hpp"
#include "sph/step/simulation.hpp"

namespace sph {
namespace {

/// A uniform gas that flies in x at 0.2, braked or not; its time step is 1.21 / (c + 0.2) h.
Scene flying(const std::string& gravity) {
  const double c = std::sqrt(1.4), dt = 1.21 / (c + 0.2) * 0.02;
  return parse_scene(R"(
dimension = 2
[domain]
lower = [0, 0]
upper = [0.4, 0.4]
periodic = [true, true]
[kernel]
h_over_dx = 1
[[group]]
name = "gas"
kind = "fluid"
eos = "ideal_gas"
heat_ratio = 1.4
density = 1
start_pressure = 1
[start]
spacing = 0.02
velocity = [0.2, 0]
[[start.region]]
group = "gas"
[time]
steps = 1
)",
                     "flying", {"domain.gravity=[" + gravity + ", 0]", "time.dt=" + std::to_string(dt)});
}

TEST(GasStart, HalfAKickRefusesNothingThatTheStepBears) {
  const decomp::Comm self(MPI_COMM_SELF);
  Simulation braked(self, flying("-4"));
  EXPECT_NO_THROW(braked.step());
  EXPECT_LT(braked.global().max_speed, 0.2);
  Simulation on(self, flying("0"));
  try {
    on.step();
    FAIL() << "a step beyond the limit";
  } catch (const GuardError& error) {
    EXPECT_EQ(std::string(error.what()).substr(0, 8), "step 1: ");
  }
}

}  // namespace
}  // namespace sph
