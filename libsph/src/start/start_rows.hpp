// Rows of a particle file, HDF5 or CSV; the order of the rows changes nothing.
//   CSV   header "id,x,y(,z),vx,vy(,vz),group,rho,m,u,T"; group is a name or an index; '#' begins a comment line
//   HDF5  data sets id, x (rows x dim), v, group, rho, m, u; or a snapshot, whose position_quanta keep every
//         bit
// rho may be missing (then from the initial pressure) and so may m (the gas content; then the group's).
// Without u [J/kg] an ideal gas has its start_pressure, without T [K] heat that of the group. Further columns: mass (else rho spacing^dim) and, in
// HDF5, stress (files/tensor_order.hpp). Grains have radius instead of these, and may have a spin (CSV: wx,
// wy, wz); their mass follows from radius and density of the group.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "decomp/grid.hpp"
#include "files/agree.hpp"
#include "sph/core/particles.hpp"
#include "sph/scene/scene.hpp"
#include "start/initial_fields.hpp"

namespace sph {

/// Dim values a row, in metres or in quanta.
struct StartPositions {
  std::vector<double> x;             ///< [m]
  std::vector<std::int64_t> quanta;  ///< instead of x, in units of `quantum` [m]
  double quantum = 0;
};

struct StartMatter {
  std::vector<double> rho, gas, energy, temperature, mass, stress;
};

struct StartGrains {
  std::vector<double> radius, spin;  ///< [m], [rad/s]
};

/// A column that the file does not have is empty.
struct StartRows {
  const char* unit = "row";          ///< "row" (from 0) or "line" (from 1), for messages
  std::vector<std::int64_t> number;  ///< of each row in the file
  std::vector<std::uint64_t> id;
  std::vector<std::uint32_t> group;
  StartPositions position;
  std::vector<double> v;  ///< dim values a row [m/s]
  StartMatter matter;     ///< of fluids and solids
  StartGrains grains;
};

/// What is wrong in one row: of all ranks' problems the one in the lowest row is reported.
struct RowProblem : InputError {
  RowProblem(std::int64_t row_number, const std::string& what) : InputError(what), number(row_number) {}
  std::int64_t number;
};

/// Rows of the file without reading them: of HDF5 exact, of CSV as many as lines like the first ones make.
[[nodiscard]] std::int64_t count_rows(const std::string& file);
[[nodiscard]] std::int64_t count_csv_rows(const std::string& file);
[[nodiscard]] std::int64_t count_hdf5_rows(const std::string& file);

/// The rank-th of `ranks` slices of the file.
[[nodiscard]] StartRows read_rows(const Scene& scene, const std::string& file, int rank, int ranks);
[[nodiscard]] StartRows read_csv_rows(const Scene& scene, const std::string& file, int rank, int ranks);
[[nodiscard]] StartRows read_hdf5_rows(const Scene& scene, const std::string& file, int rank, int ranks);

/// Throws RowProblem naming row k.
[[noreturn]] void fail_row(const StartRows& rows, std::size_t k, const std::string& what);

/// Throws RowProblem unless the values of row k can be those of a particle of the scene not far from it.
void check_row(const StartRows& rows, std::size_t k, const Scene& scene);

/// Position of row k, not wrapped.
[[nodiscard]] decomp::Int3 quanta_of(const StartRows& rows, std::size_t k, const PositionScale& scale,
                                     int dim);

/// Adds row k as particle `id` at `quanta`, wrapped; `fields` has what the file does not say.
void add_row(const StartRows& rows, std::size_t k, std::uint64_t id, const decomp::Int3& quanta,
             const InitialFields& fields, const Scene& scene, const PositionScale& scale,
             Particles& particles);

/// Runs `work` on every rank; throws what it threw in the lowest row of the file, on every rank.
template <class Work>
void in_row_order(const decomp::Comm& comm, const std::string& file, Work&& work) {
  constexpr std::int64_t none = std::numeric_limits<std::int64_t>::max();
  std::int64_t number = none;
  std::string text;
  try {
    work();
  } catch (const RowProblem& problem) {
    number = problem.number;
    text = problem.what();
  } catch (const std::exception& error) {
    number = 0;
    text = error.what();
  }
  const std::int64_t lowest = -comm.max(-number);
  if (lowest == none) return;
  throw InputError(file + ": " + agree(comm, number == lowest ? text : std::string()));
}

}  // namespace sph
