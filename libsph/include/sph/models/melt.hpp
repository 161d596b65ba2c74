// Melts that flow slowly on a grid, with heat and composition: -div 2 eta eps(U) + grad p = rho g, div U = 0,
//   rho = rho_0(C) (1 - alpha (T - T_0)),   ln eta = ln eta_0(C) - b (T - T_0),
// rho_0 and ln eta_0 linear in the share C of the second melt; d_t T + div U T = kappa lap T, d_t C + div U C = 0. Its
// rows are the cells. A step takes the flow of its beginning.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sph/models/cell_rows.hpp"
#include "sph/models/model.hpp"
#include "sph/scene/scene.hpp"
#include "stokes/conduction.hpp"
#include "stokes/solver.hpp"
#include "stokes/transport.hpp"

namespace sph {

class Melt final : public Model {
 public:
  Melt(std::size_t set, const decomp::Comm& comm, const Scene& scene, const PositionScale& scale);
  [[nodiscard]] static FieldSet fields(const Scene& scene);
  [[nodiscard]] Plan plan();
  [[nodiscard]] const CellRows& rows() const { return rows_; }
  [[nodiscard]] double bytes_of_cell() const;  ///< of what a step works with

  void reserve(Reduction& r) override { courant_rate_ = r.add_maximum(); }
  [[nodiscard]] double start(const decomp::Comm&, Particles& cells, GlobalState&) override;
  [[nodiscard]] bool report(const StepState&, Reduction&) override;
  [[nodiscard]] double longest_step(const Reduction&) const override;

  /// Columns of series.csv: iterations and residual of the last flow, root of the mean square of U [m/s], means of T
  /// [K] and C, and the mean of what comes in through each side that is not insulated [K m/s].
  [[nodiscard]] std::vector<std::string> columns() const;
  /// Collective.
  [[nodiscard]] std::vector<double> values(const Particles& cells);

 private:
  /// What a step works with, over the patch; not made where a scene is only looked at.
  struct Work {
    Work(const decomp::Comm& comm, const Scene& scene, const std::vector<decomp::Box>& boxes);
    [[nodiscard]] const stokes::Patch& patch() const { return solver.patch(); }
    stokes::Solver solver;
    stokes::Transport transport;
    std::optional<stokes::Conduction> conduction;
    stokes::Flow flow;
    stokes::Field temperature, composition, share;
  };
  void flow(StepState& state);
  void carry(StepState& state);
  /// From the rows; the first time it makes the work. Collective.
  void load(const Particles& cells);
  [[nodiscard]] stokes::Field densities() const;
  [[nodiscard]] stokes::Field viscosities() const;
  [[nodiscard]] stokes::Velocity driving_force(const stokes::Field& densities);
  void take_off_layers(std::size_t axis, stokes::Field& force) const;
  [[nodiscard]] stokes::Resistance stratification(double dt);

  const decomp::Comm* comm_;
  const Scene* scene_;
  PositionScale scale_;
  CellRows rows_;
  std::unique_ptr<Work> work_;
  stokes::Effort effort_;
  double courant_step_ =
      any_step;  ///< in which the flow passes `courant` cells, and heat not much of the domain [s]
  Reduction::Maximum courant_rate_;  ///< courant over it is the longest step [1/s]
};

}  // namespace sph
