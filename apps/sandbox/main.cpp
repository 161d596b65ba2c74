// Sand between two walls, one of which pushes: a wedge of thrusts. Cases: sandbox.toml, sandbox_fine.toml.
#include "sph/run/command_line.hpp"

int main(int argc, char** argv) {
  const sph::Application application{
      .name = "sandbox",
      .description =
          "A wall pushes a layer of sand over a floor: thrusts, wedge, wall force. Cases: sandbox.toml "
          "(default), sandbox_fine.toml, shear_sand.toml, shear_floor.toml",
      .default_case = "sandbox.toml",
      .case_folders = {sph::program_folder() / PEPERITE_INSTALLED_CASES, PEPERITE_SOURCE_CASES}};
  return sph::application_main(argc, argv, application);
}
