// Where files come from: the scene and state they hold, and the program that wrote them.
#pragma once

#include <string>
#include <vector>

namespace sph {

/// What every file says about the state in it.
struct Provenance {
  std::string scene_toml;
  std::string fingerprint;
  std::vector<std::string> group_names;
};

/// Git revision, compiler, flags, MPI, HDF5: filled in at build time, for the banner and every file.
struct BuildInfo {
  std::string version, git, compiler, flags, build_type, mpi, hdf5;
};
[[nodiscard]] const BuildInfo& build_info();

}  // namespace sph
