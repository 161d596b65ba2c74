// The start from a file: columns id, x, v, group, rho, m (HDF5 or CSV). Every rank reads a slice of the rows,
// checks it and sends each particle to its owner; the order of the rows in the file changes nothing.
//   CSV   header "id,x,y(,z),vx,vy(,vz),group,rho,m"; group is a name or an index; '#' begins a comment line
//   HDF5  data sets id, x (rows x dim), v, group, rho, m; or a snapshot, whose position_quanta keep every bit
// rho may be missing (then from the initial pressure) and so may m (the gas content; then the group's).
// Further columns: mass (else rho spacing^dim) and, in HDF5, stress.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sph/distribution.hpp"
#include "sph/particles.hpp"
#include "sph/scene.hpp"

namespace sph {

/// This rank's slice. A column that the file does not have is empty.
struct StartRows {
  const char* unit = "row";          ///< "row" (from 0) or "line" (from 1), for messages
  std::vector<std::int64_t> number;  ///< of each row in the file
  std::vector<std::uint64_t> id;
  std::vector<double> x, v;          ///< dim values a row [m], [m/s]
  std::vector<std::int64_t> quanta;  ///< positions instead of x, in units of `quantum` [m]
  double quantum = 0;
  std::vector<std::uint32_t> group;
  std::vector<double> rho, gas, mass, stress;
};

/// What is wrong in one row: of all ranks' problems the one in the lowest row is reported.
struct RowProblem : InputError {
  RowProblem(std::int64_t row_number, const std::string& what) : InputError(what), number(row_number) {}
  std::int64_t number;
};

[[nodiscard]] StartRows read_csv_rows(const Scene& scene, int rank, int ranks);
[[nodiscard]] StartRows read_hdf5_rows(const Scene& scene, int rank, int ranks);

/// Fills `particles` (empty) with this rank's share. Throws InputError "file: row: what" on all ranks.
void place_particles_from_file(const Scene& scene, const PositionScale& scale, Distribution& distribution,
                               Particles& particles);

}  // namespace sph
