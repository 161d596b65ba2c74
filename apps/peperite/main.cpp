// peperite: runs, checks, resumes, describes and compares; draws, reports, exports and sweeps by the package of Python.
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "sph/core/error.hpp"
#include "sph/run/command_line.hpp"

namespace {

namespace fs = std::filesystem;

/// The package beside the installed program, else in the source tree.
std::string package_folder() {
  std::error_code none;
  const fs::path installed = (sph::program_folder() / PEPERITE_INSTALLED_PYTHON).lexically_normal();
  return fs::exists(installed / "peperite", none) ? installed.string() : PEPERITE_SOURCE_PYTHON;
}

/// Becomes Python, which runs the module with the other arguments: PEPERITE_PYTHON, or that of the system.
int become(const char* module, int argc, char** argv) {
  if (const char* rank = std::getenv("OMPI_COMM_WORLD_RANK");
      rank != nullptr && std::string_view(rank) != "0")
    return sph::exit_done;
  std::string path = package_folder();
  const char* theirs = std::getenv("PYTHONPATH");
  std::istringstream folders(theirs != nullptr ? theirs : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (!folder.empty()) path += ":" + folder;  // an empty one is where somebody stands
  setenv("PYTHONPATH", path.c_str(), 1);
  std::error_code none;
  setenv("PEPERITE_PROGRAM", fs::read_symlink("/proc/self/exe", none).c_str(), 1);
  const char* chosen = std::getenv("PEPERITE_PYTHON");
  const char* python = chosen != nullptr                       ? chosen
                       : access("/usr/bin/python3", X_OK) == 0 ? "/usr/bin/python3"
                                                               : "python3";
  setenv("PYTHONSAFEPATH", "1", 1);  // or a file numpy.py where somebody stands would be numpy
  std::vector<const char*> words{python, "-B", "-m", module};
  words.insert(words.end(), argv + 2, argv + argc);
  words.push_back(nullptr);
  execvp(python, const_cast<char**>(words.data()));
  std::fprintf(stderr, "peperite: error: cannot start %s; PEPERITE_PYTHON names another\n", python);
  return sph::exit_input;
}

}  // namespace

int main(int argc, char** argv) {
  constexpr std::array modules{std::pair{"plot", "peperite.drawing"}, std::pair{"report", "peperite.report"},
                               std::pair{"sweep", "peperite.sweep"}, std::pair{"export", "peperite.export"}};
  for (const auto& [name, module] : modules)
    if (argc > 1 && std::string_view(argv[1]) == name) return become(module, argc, argv);
  return sph::tool_main(argc, argv);
}
