// One grid of the hierarchy on one rank: its cells, their copies on other ranks, the viscous operator, and a smoother
// that reads old values only, so that no cut shows: Chebyshev's polynomial of the diagonal (Adams et al. 2003).
#pragma once

#include "decomp/box_exchange.hpp"
#include "decomp/comm.hpp"
#include "stokes/grid.hpp"
#include "stokes/viscous_operator.hpp"

namespace stokes {

class Level {
 public:
  /// `boxes`: of all ranks of `comm`.
  Level(const decomp::Comm& comm, const Grid& grid, std::vector<Box> boxes);

  [[nodiscard]] const Patch& patch() const { return patch_; }
  [[nodiscard]] const Grid& grid() const { return patch_.grid; }
  [[nodiscard]] const std::vector<Box>& boxes() const { return boxes_; }
  [[nodiscard]] const decomp::Comm& comm() const { return *comm_; }
  [[nodiscard]] Velocity make_velocity() const;

  /// Copies of other ranks' cells, periodic images, images behind walls.
  void refresh(Velocity& u);
  void refresh_cells(Field& c);

  /// Viscosities of the cells and resistances of the faces, of which `refresh_cells` has been asked; finds what follows
  /// from them. Collective.
  void set_viscosity(Field cells, EdgeMean mean, Resistance resistance);
  [[nodiscard]] const Viscosity& viscosity() const { return viscosity_; }

  /// f - A u with its copies, until the next call of the level; refreshes u.
  [[nodiscard]] const Velocity& residual(const Velocity& f, Velocity& u);
  /// Improves u towards A u = f by a polynomial of A; `from_zero`: u is 0.
  void smooth(const Velocity& f, Velocity& u, int degree, bool from_zero);

 private:
  [[nodiscard]] double largest_eigenvalue();
  void find_residual(const Velocity& f, Velocity& u);

  const decomp::Comm* comm_;
  std::vector<Box> boxes_;
  Patch patch_;
  decomp::BoxExchange halo_;
  Viscosity viscosity_;
  Velocity inverse_diagonal_;
  double largest_ = 2;  ///< bound on the eigenvalues of D^-1 A
  Velocity r_, step_;   ///< scratch
};

}  // namespace stokes
