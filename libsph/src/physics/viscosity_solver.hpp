// The implicit viscous step: v(t + dt) = v(t) + dt a with the viscous forces of v(t + dt), so that they limit
// no time step. For the change c = v(t + dt) - v(t)
//   (m - dt L) c = dt (F + m g + L v(t)),
// L the viscous operator (terms/viscous_operator.hpp), m - dt L symmetric and positive definite: conjugate
// gradients, preconditioned by the diagonal, with the two dot products of an iteration in one reduction
// (Chronopoulos & Gear 1989). Dot products are exact sums of one term a particle, so the iterations are
// the same on any number of ranks. They start from c = 0 and stop when the residual, a spurious impulse, is
// less than `tolerance` of the larger one of the impulses of viscous and of all other forces: so far momentum
// is conserved.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "decomp/exact_sum.hpp"
#include "sph/physics.hpp"

namespace sph {

class ViscositySolver final : public Solver {
 public:
  ViscositySolver(const Physics& physics, double tolerance) : physics_(&physics), tolerance_(tolerance) {}

  /// The first direction is the velocity itself, of walls that of their material.
  void begin(Particles& particles, const RowRanges& ranges);

  /// This rank's part of the dot products after the operator was applied; to be summed over all ranks. None
  /// the first time.
  [[nodiscard]] std::span<decomp::ExactSum> products(const StepState& state) override;

  /// Sets the next direction and says true; or says that it is enough, and Field::force then holds the
  /// force with which the kick ends at v(t + dt). Throws GuardError when that takes too many iterations.
  [[nodiscard]] bool improve(StepState& state) override;

 private:
  void set_out(Particles&, const RowRanges&, double dt);
  void finish(Particles&, const RowRanges&, double dt) const;

  const Physics* physics_;
  double tolerance_;
  int iteration_ = 0;
  double product_ = 0, length_ = 0, enough_ = 0;  ///< r.u, alpha and its bound, of the last iteration
  std::array<decomp::ExactSum, 4> sums_;          ///< r.u, w.u; driving and viscous impulses squared
  // By row and component: change of velocity, residual, search direction, operator on the direction and on
  // the search direction; diagonal by row.
  std::vector<double> change_, residual_, search_, image_, search_image_, diagonal_;
};

}  // namespace sph
