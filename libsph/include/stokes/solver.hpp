// Slow flow of a fluid of variable viscosity: -div 2 eta eps(u) + c u + grad p = f, div u = s, on a staggered grid.
// FGMRES (Saad 1993), preconditioned from the right by the block triangle [A G; 0 -S], S = 1 / eta the pressure's mass
// and A^-1 one V-cycle, or conjugate gradients with it where that is slow. Dot products are exact sums of terms that are
// rounded once, updates read old values only, and the grid's cuts meet no arithmetic: the same bits on any number of ranks.
#pragma once

#include <deque>
#include <vector>

#include "stokes/multigrid.hpp"

namespace stokes {

/// Velocities on faces and pressures in cells, over the finest patch.
struct Flow {
  Velocity u;
  Field p;
};

struct Effort {
  int iterations = 0;
  int cycles = 0;  ///< V-cycles: one an iteration unless these are slow
  double residual =
      0;  ///< |r| / |right-hand side| of what is returned; of no force infinite, unless nothing moves
  bool converged = false;  ///< the residual is at most the tolerance
};

class Solver {
 public:
  /// `boxes`: who has which cells (even_boxes).
  Solver(const decomp::Comm& comm, const Grid& grid, std::vector<Box> boxes);

  [[nodiscard]] const Patch& patch() const { return multigrid_.finest().patch(); }
  [[nodiscard]] Flow make_flow() const;
  /// Copies of other ranks' cells, periodic images, images behind walls. Collective.
  void refresh(Field& cells) { multigrid_.finest().refresh_cells(cells); }
  /// Of cells [Pa s], and of faces, as far as they resist, c [Pa s/m^2], over the patch; copies need not be up to date.
  /// Collective.
  void set_viscosity(Field cells, Resistance resistance = {});
  /// Improves `x` until |r| <= tolerance |f|; residuals of the divergence count times the least eta / h. Where a mean velocity or
  /// pressure is free it is 0 then; where no wall holds a component of the force its mean is taken off, and so is that of
  /// the source s [1/s], and of what faces resist. Where |f| is less than `least_norm`, what is left of it by rounding,
  /// that counts instead. Collective.
  [[nodiscard]] Effort solve(Velocity force, Flow& x, double tolerance, int most_iterations = 200,
                             const Field* source = nullptr, double least_norm = 0);

 private:
  /// y = K x; refreshes x.
  void apply_all(Flow& x, Flow& y);
  /// Returns the number of V-cycles.
  int precondition(const Flow& r, bool thorough, Flow& z);
  /// Of w with each of `others`, over all ranks.
  [[nodiscard]] std::vector<double> dots(const Flow& w, const std::vector<const Flow*>& others);
  [[nodiscard]] double norm(const Flow& w);
  void take_off_mean(Field& values);
  void take_off_free_means(Velocity& u);
  void take_off_resisted_means(Velocity& u);
  /// One cycle of the Krylov method from the residual that is first in the basis.
  void improve(Flow& x, double beta, double wanted, int most, bool thorough, Effort& effort);

  /// The k-th of flows that stay allocated from one solution to the next.
  [[nodiscard]] Flow& kept(std::deque<Flow>& flows, std::size_t k) const;

  const decomp::Comm* comm_;
  Multigrid multigrid_;
  double per_divergence_ = 1;       ///< least eta / h, squared [(Pa s/m)^2]
  std::deque<Flow> basis_, steps_;  ///< of the Krylov space, before and after preconditioning; scratch
  Velocity driven_;                 ///< scratch
};

}  // namespace stokes
