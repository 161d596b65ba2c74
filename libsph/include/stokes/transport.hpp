// What a flow carries, by finite volumes (unsplit): d_t M + div u = 0 of the share M of a cell that carries, and
// d_t (C M) + div (u C) = 0. Faces have Koren's limited value of third order (Koren 1993) from upwind, time steps are
// Heun's (SSP-RK2; Shu & Osher 1988). With F = u area dt / volume, inward, a stage is
//   M' = M + sum F,   C' = C + sum F (C_face - C) / M',
// which conserves C M, and leaves a uniform C as it is to the bit. From old values only: no cut shows.
#pragma once

#include <span>
#include <vector>

#include "decomp/box_exchange.hpp"
#include "decomp/comm.hpp"
#include "stokes/conduction.hpp"
#include "stokes/grid.hpp"

namespace stokes {

/// Per volume of M. What lies behind walls mirrors it, or is what conduction sees there: where the flow leaves a wall that
/// keeps a temperature, mirror images would have the limiter take its layer for an extremum.
struct Carried {
  Field* values = nullptr;
  const Conduction* conduction = nullptr;
};

class Transport {
 public:
  /// `boxes`: of all ranks of `comm`. Periodic axes have 2 cells at least. Collective.
  Transport(const decomp::Comm& comm, const Grid& grid, std::vector<Box> boxes);

  [[nodiscard]] const Patch& patch() const { return patch_; }  ///< of all fields; its copies are not read

  /// One step of `dt` [s]. u [m/s]: of volume, per area of face, whatever M is; through walls nothing goes. `volume`:
  /// M, 1 in a pure fluid. There are no new extrema where the |F| of a cell's faces sum up
  /// to at most the M of both stages, M + sum F and M + 2 sum F. Where M is not above 0 what is carried stays as it is.
  /// Collective.
  void advect(const Velocity& u, double dt, Field& volume, std::span<const Carried> carried);

  /// The time [s] in which u passes the share `cfl` of a cell: cfl / max sum_a |u_a| / edge_a, of a cell's faster face
  /// along each axis, and no cell gains or loses more than a tenth of its volume: what is left of a flow at rest is the
  /// solver's residual, which has a divergence as large as itself. With M = 1 and up to cfl = 1/2 there are no new
  /// extrema. Infinite at rest. Collective.
  [[nodiscard]] double longest_step(const Velocity& u, double cfl);

 private:
  /// u dt / edge on the lower and upper faces of the rank's cells.
  void set_courant(const Velocity& u, double dt);
  /// The rank's cells of `fields` and their copies, into `wide_values_`.
  void widen(std::span<const Carried> fields);

  const decomp::Comm* comm_;
  Patch patch_, wide_;  ///< the limiter looks at two cells on either side
  decomp::BoxExchange face_halo_, cell_halo_;
  Velocity courant_;
  Field growth_;  ///< of M in a step
  std::vector<Field> wide_values_, stage_;
};

}  // namespace stokes
