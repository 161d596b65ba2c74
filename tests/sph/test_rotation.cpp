// A drop that spins in free flight: the continuity equation must not make it thinner in every turn. With
// velocities of half a step ago and positions of now its density falls by (omega dt)^2 a step, it is pulled
// together, spins faster and blows up.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "sph/step/simulation.hpp"

namespace {

constexpr const char* scene_text = R"(
dimension = 2
[domain]
lower = [-1, -1]
upper = [1, 1]
[kernel]
h_over_dx = 1.2
[[group]]
name = "water"
kind = "fluid"
density = 1000
sound_speed = 20
[start]
spacing = 0.05
file = "drop.csv"
[time]
cfl = 0.8
steps = 240
)";

TEST(Rotation, SpinningDropKeepsItsDensity) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("peperite_drop_" + std::to_string(getpid()));
  std::filesystem::create_directory(folder);
  {
    std::ofstream csv(folder / "drop.csv");
    csv << "id,x,y,vx,vy,group,rho,m\n";
    int id = 0;
    for (int k = 0; k < 6; ++k) {  // a hexagon of 1 dx, 1 m/s at its corners
      const double angle = k * 1.0471975511965976, x = std::cos(angle), y = std::sin(angle);
      csv << ++id << ',' << 0.05 * x << ',' << 0.05 * y << ',' << -y << ',' << x << ",0,1000,0\n";
    }
    std::ofstream(folder / "drop.toml") << scene_text;
  }
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s(comm, sph::read_scene((folder / "drop.toml").string(), {}));
  for (int k = 0; k < 240; ++k) {
    s.step();
    const double* rho = s.particles().data<sph::Field::density>();
    for (std::size_t i = 0; i < s.particles().owned(); ++i) ASSERT_NEAR(rho[i], 1000, 10) << "step " << k;
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
