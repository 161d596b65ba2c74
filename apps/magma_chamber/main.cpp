// Crystals in two melts heated from below. Cases: chamber.toml, collapse.toml.
#include "sph/run/command_line.hpp"

int main(int argc, char** argv) {
  const sph::Application application{
      .name = "magma_chamber",
      .description =
          "Crystals in the slow flow of two melts, heated from below: they are trapped where the melts meet "
          "(chamber.toml, default), or fall as a whole (collapse.toml)",
      .default_case = "chamber.toml",
      .case_folders = {sph::program_folder() / PEPERITE_INSTALLED_CASES, PEPERITE_SOURCE_CASES}};
  return sph::application_main(argc, argv, application);
}
