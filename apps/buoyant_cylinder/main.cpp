// Ida's buoyant cylinder in magma: elastic (solid.toml), fluid (fluid.toml), bubbly (gas.toml).
#include "sph/run/command_line.hpp"

int main(int argc, char** argv) {
  const sph::Application application{
      .name = "buoyant_cylinder",
      .description =
          "A light cylinder rises through magma. Cases: fluid.toml (default), solid.toml, gas.toml, "
          "fluid_fine.toml",
      .default_case = "fluid.toml",
      .case_folders = {sph::program_folder() / PEPERITE_INSTALLED_CASES, PEPERITE_SOURCE_CASES}};
  return sph::application_main(argc, argv, application);
}
