// The PEPERITE_* values are compile definitions of this file alone, so that a new revision recompiles
// nothing else.
#include <mpi.h>

#include <array>

#include "files/hdf5_file.hpp"
#include "sph/files/provenance.hpp"

namespace sph {
namespace {

/// "Open MPI v4.1.4" of "Open MPI v4.1.4, package: ..., ident: ...".
std::string mpi_version() {
  std::array<char, MPI_MAX_LIBRARY_VERSION_STRING> text{};
  int length = 0;
  MPI_Get_library_version(text.data(), &length);
  const std::string all(text.data(), static_cast<std::size_t>(length));
  return all.substr(0, all.find_first_of(",\n"));
}

}  // namespace

const BuildInfo& build_info() {
  static const BuildInfo built{PEPERITE_VERSION,    PEPERITE_GIT,  PEPERITE_COMPILER, PEPERITE_FLAGS,
                               PEPERITE_BUILD_TYPE, mpi_version(), hdf5_version()};
  return built;
}

}  // namespace sph
