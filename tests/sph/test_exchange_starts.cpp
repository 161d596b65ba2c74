// Fixed time steps that are too long for what a start has: refused before the first step, as all bad input is.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sph/step/simulation.hpp"

namespace {

std::string refusal(const std::string& magma, const std::string& dt,
                    const std::vector<std::string>& more = {}) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  const std::string scene =
      "[domain]\nlower = [0, 0]\nupper = [12, 12]\nperiodic = [true, true]\nsurface_pressure = "
      "1e6\n[kernel]\n"
      "h_over_dx = 1.0\n[[group]]\nname = \"magma\"\nkind = \"fluid\"\neos = \"bubbly\"\ndensity = 2500\n"
      "sound_speed = 100\ngas_content = 0.01\ngas_rt = 5e5\nsolubility_pressure = 1e9\n" +
      magma + "[start]\nspacing = 1\n[[start.region]]\ngroup = \"magma\"\n[time]\nsteps = 1\n" +
      (dt.empty() ? "" : "dt = " + dt + "\n");
  try {
    sph::Simulation(comm, sph::parse_scene(scene, "scene", more));
  } catch (const sph::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ExchangeStarts, RefuseSteps) {
  const std::string flows = "permeability = { coefficient = 1e-8 }\n";
  EXPECT_EQ(refusal(flows, "1e-5"), "");
  EXPECT_NE(refusal(flows, "5e-3").find("scene: time.dt: 0.005 s is above the limit of gas that flows"),
            std::string::npos)
      << refusal(flows, "5e-3");
  // Foam of 206 kg/m^3: twelve times as light as its liquid, and shaken as much more by the same viscosity.
  const std::string thick = "bulk_viscosity = 1e6\n";
  EXPECT_EQ(refusal(thick, "1e-5"), "");
  EXPECT_NE(refusal(thick, "1.5e-3").find("above their limit"), std::string::npos)
      << refusal(thick, "1.5e-3");
  // All is dissolved where the scene is looked at, little where it starts.
  const std::string law = "viscosity_law = { law = \"hess_dingwell\", temperature = 1100 }\n";
  EXPECT_EQ(refusal(law, "1e-9"), "");
  EXPECT_NE(refusal(law, "1e-4").find("above their limit"), std::string::npos) << refusal(law, "1e-4");
}

// Gas in bubbles that are not connected, and nothing moves: without time.dt there is no longest step.
TEST(ExchangeStarts, RefuseStepsWithoutEnd) {
  const std::string tight =
      "permeability = { law = \"percolation\", coefficient = 1e-8, threshold = 0.99 }\n";
  EXPECT_EQ(refusal(tight, "1", {"terms.motion=false"}), "");
  // Nor does any viscosity limit a step that is given.
  EXPECT_EQ(refusal(tight + "viscosity = 1e9\n", "1e6", {"terms.motion=false"}), "");
  for (const char* implicit : {"terms.implicit_gas_flow=false", "terms.implicit_gas_flow=true"})
    EXPECT_EQ(
        refusal(tight, "", {"terms.motion=false", implicit}),
        "scene: terms.motion: is false, no gas flows at the start, and nothing limits the time step; give "
        "time.dt");
}

}  // namespace
