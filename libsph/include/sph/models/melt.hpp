// Melts that flow slowly on a grid, with heat and composition: -div 2 eta eps(U) + grad p = rho g, div U = 0,
//   rho = rho_0(C) (1 - alpha (T - T_0)),   ln eta = ln eta_0(C) - b (T - T_0),
// rho_0 and ln eta_0 linear in the share C of the second melt; d_t T + div U T = kappa lap T, d_t C + div U C = 0. Its
// rows are the cells. A step takes the flow of its beginning. With grains in it (suspension.hpp) U is the velocity of
// both, the melt has the share M = 1 - phi of a cell, what it carries goes with d_t (C M) + div (u_m C) = 0, u_m its own
// flux of volume, and a flow serves for several steps of the grains.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sph/models/cell_rows.hpp"
#include "sph/models/melt_work.hpp"
#include "sph/models/model.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

class Melt final : public Model {
 public:
  Melt(std::size_t set, const decomp::Comm& comm, const Scene& scene, const PositionScale& scale);
  [[nodiscard]] static FieldSet fields(const Scene& scene);
  [[nodiscard]] Plan plan();
  [[nodiscard]] const CellRows& rows() const { return rows_; }

  /// A flow is found in the step that begins.
  [[nodiscard]] bool is_due(const GlobalState& global) const { return !has_grains_ || global.flow.left == 0; }
  /// The step at hand is the last one of a flow.
  [[nodiscard]] bool is_last(const GlobalState& global) const;
  /// From the rows; the first time it makes the work. Collective.
  MeltWork& load(const Particles& cells);
  [[nodiscard]] MeltWork& work() { return *work_; }  ///< once it is loaded
  /// Of what a step works with.
  [[nodiscard]] double bytes_of_cell() const;

  void reserve(Reduction& r) override {
    courant_rate_ = r.add_maximum();
    beyond_ = r.add_maximum();
  }
  [[nodiscard]] double start(const decomp::Comm&, Particles& cells, GlobalState&) override;
  [[nodiscard]] bool report(const StepState&, Reduction&) override;
  [[nodiscard]] double longest_step(const Reduction&) const override;
  void guard_step(const Reduction&, const GlobalState&) const override;

  /// Columns of series.csv: iterations and residual of the last flow, root of the mean square of U [m/s], means of T
  /// [K] and C, and the mean of what comes in through each side that is not insulated [K m/s].
  [[nodiscard]] std::vector<std::string> columns() const;
  /// Collective.
  [[nodiscard]] std::vector<double> values(const Particles& cells, const GlobalState& global);

 private:
  void flow(StepState& state);
  /// The longest step [s] in which what the solver leaves unknown of a flow at rest does not count. Throws GuardError
  /// of what makes no sense. Collective.
  [[nodiscard]] double settling_step(const GlobalState& global, const stokes::Field& rho,
                                     const stokes::Field& eta) const;
  void carry(StepState& state);
  void advect_beside_grains(double dt, stokes::Field& both, std::span<const stokes::Carried> with_all);

  const decomp::Comm* comm_;
  const Scene* scene_;
  PositionScale scale_;
  CellRows rows_;
  bool has_grains_;
  std::unique_ptr<MeltWork> work_;  ///< not made where a scene is only looked at
  double courant_step_ =
      any_step;  ///< in which the flow passes `courant` cells, and heat not much of the domain [s]
  Reduction::Maximum courant_rate_;  ///< courant over it is the longest step [1/s]
  Reduction::Maximum beyond_;        ///< how far shares of the second melt are below 0 or above 1
};

}  // namespace sph
