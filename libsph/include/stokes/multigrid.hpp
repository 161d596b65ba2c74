// One V-cycle for the viscous operator of a staggered grid: linear transfers, restriction their transpose over 2^dim,
// coarse viscosities means of finer ones (arithmetic; harmonic at the finest edges), and on the coarsest grid, which every
// rank has, a dense Cholesky factor. Coarse grids go to fewer ranks when tiles cannot be halved any more.
#pragma once

#include <memory>
#include <vector>

#include "stokes/level.hpp"

namespace stokes {

/// Of the polynomial that smooths a level, 0 the finest. Coarse viscosities are means, of which a coarse grid corrects
/// worse than the finest one: with one degree for all, iterations grow with depth where viscosity jumps. Work that grows
/// towards coarse levels stops that (variable V-cycle, Bramble & Pasciak 1987) and costs little, as these have few cells.
[[nodiscard]] int smoothing_degree(std::size_t level);

/// Throws decomp::InputError for a number of cells that is not m 2^k with m <= 7 along each axis.
void check_cells(const Grid& grid);

class Multigrid {
 public:
  /// `boxes`: of the finest grid (even_boxes). Throws as check_cells().
  Multigrid(const decomp::Comm& comm, const Grid& grid, std::vector<Box> boxes);

  [[nodiscard]] Level& finest() { return *levels_.front(); }
  [[nodiscard]] const Level& finest() const { return *levels_.front(); }
  [[nodiscard]] std::size_t depth() const { return levels_.size(); }

  /// Of the finest cells and faces (viscous_operator.hpp), over its patch; copies need not be up to date. Collective.
  void set_viscosity(Field cells, Resistance resistance);
  /// u = about A^-1 f. Collective.
  void cycle(const Velocity& f, Velocity& u);

 private:
  /// Between a grid and the next coarser one, whose cells are at first where their finer ones are.
  struct Transfer {
    Patch half;
    decomp::BoxExchange down, up;
    Velocity halves, force, velocity;  ///< scratch: over `half`, and over the coarser grid's patch
  };
  void cycle(std::size_t k, const Velocity& f, Velocity& u);
  /// The values of a finer grid's coarse cells go to those who have them.
  void restrict_to(std::size_t coarse, std::vector<Field*> halves, std::vector<Field*> values);
  void factorise();
  void solve_coarsest(const Velocity& f, Velocity& u) const;

  decomp::Comm alone_;
  std::vector<std::unique_ptr<Level>> levels_;
  std::vector<std::unique_ptr<Transfer>> transfers_;  ///< of level k to k + 1
  std::vector<double> factor_;                        ///< of the coarsest operator, lower triangle by rows
};

}  // namespace stokes
