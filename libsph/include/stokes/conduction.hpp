// Implicit conduction of a cell field: d_t T = kappa lap T, second order in space, the theta scheme in time,
//   (I - theta dt kappa L) D = dt kappa L T_old,   T = T_old + D,
// by Chebyshev's semi-iteration (Golub & Varga 1961) on the bounds of its spectrum, 1 and 1 + theta dt kappa sum_a
// 4 / edge_a^2. They also say how many steps are needed: nothing is reduced, and no cut shows.
#pragma once

#include <vector>

#include "decomp/box_exchange.hpp"
#include "decomp/comm.hpp"
#include "decomp/exact_sum.hpp"
#include "stokes/grid.hpp"

namespace stokes {

/// What a wall does, half a cell from the centres of the cells at it.
struct ThermalWall {
  enum class Kind : std::uint8_t { insulating, temperature, flux };
  Kind kind = Kind::insulating;
  double value = 0;  ///< the temperature [K], or the flux inward, kappa dT/dn [K m/s]
};
using ThermalWalls =
    std::array<std::array<ThermalWall, 2>, 3>;  ///< [axis][lower, upper]; not of periodic axes

class Conduction {
 public:
  /// `boxes`: of all ranks of `comm`. `diffusivity`: kappa > 0 [m^2/s]. Collective.
  Conduction(const decomp::Comm& comm, const Grid& grid, const std::vector<Box>& boxes, double diffusivity,
             const ThermalWalls& walls);

  [[nodiscard]] const Patch& patch() const { return patch_; }  ///< of T [K]; its copies are not read

  /// T after `dt` [s], D within 1e-12 of its norm. theta = 1: backward Euler, of first order, damps what is short however
  /// long the step; 1/2: Crank-Nicolson, of second order. Returns the number of iterations, about 14 times
  /// the root of the upper bound of the spectrum. `volume`: what of a cell is warmed, M, about 1: of M T the sum is conserved,
  /// as M T = M T_old + D. Collective.
  int advance(double dt, Field& temperature, double theta = 1, const Field* volume = nullptr);

  /// The nearest layer of copies behind walls, of any patch of the grid: on a straight line through the cell at the wall
  /// and what that keeps, `share` times it.
  void extend(const Patch& patch, Field& temperature, double share = 1) const;

  /// What goes in through a side of the domain [K m/s], summed over the faces that are this rank's; its mean over all
  /// faces of the side, which is collective. 0 of periodic axes.
  [[nodiscard]] decomp::ExactSum inflow(const Field& temperature, int axis, int side) const;
  [[nodiscard]] double mean_inflow(const Field& temperature, int axis, int side) const;

 private:
  /// Copies of `t`; `change`: it is a difference of two temperatures.
  void refresh(Field& t, bool change);

  const decomp::Comm* comm_;
  Patch patch_;
  decomp::BoxExchange halo_;
  double diffusivity_;
  ThermalWalls walls_;
  Field right_, change_, next_, step_;
};

}  // namespace stokes
