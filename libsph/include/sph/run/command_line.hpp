// The two kinds of program, each a whole main: an application runs its cases, the tool also looks at files.
// They start MPI, read the command line and turn errors into one line on stderr and an exit code.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sph {

struct Application {
  std::string name, description;
  std::string default_case;                         ///< file name
  std::vector<std::filesystem::path> case_folders;  ///< where cases are looked for, in this order
};

/// <app> [case.toml] [--out DIR] [--set k=v]... [--steps N | --until T] [--max-time H:M:S]
[[nodiscard]] int application_main(int argc, char** argv, const Application& application);

/// peperite run|check|resume|info|diff
[[nodiscard]] int tool_main(int argc, char** argv);

/// The folder of the running program; empty if the system does not say.
[[nodiscard]] std::filesystem::path program_folder();

}  // namespace sph
