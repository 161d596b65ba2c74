// Gas that flows through bubbly magma and out of it (Ida eq. 16): the liquid of a particle stays, its gas content m is
// exchanged pair by pair (terms/gas_flow.hpp) with its volume as it is, so that mass, density and pressure follow. Gas
// escapes through free surfaces (surface_escape.hpp) and walls that let it pass, and is counted for each particle:
//   sum M m - sum (gas from outside) = what it was at the start,
// but for rounding. Explicit: dt <= 0.3 h^2 / D, D = k b (1 + m) / rho dp/dm of a fixed volume. Implicit
// (src/models/gas_flow_solver.hpp): no content changes by more than 5 % of the largest in a step.
#pragma once

#include <memory>

#include "sph/models/builder.hpp"
#include "sph/models/model.hpp"
#include "sph/models/surface_escape.hpp"

namespace sph {

/// Some walls let gas pass.
[[nodiscard]] bool has_open_walls(const Scene& scene);
/// Gas leaves through a free surface.
[[nodiscard]] bool has_escape(const Scene& scene);

/// Of gas contents in a step, as far as this rank knows.
struct ContentChange {
  double most = 0, content = 0;
  void see(double change, double of);
};

class Degassing final : public Model {
 public:
  Degassing(std::size_t set, const SphConstants& constants, const Materials& materials)
      : Model(set), constants_(&constants), materials_(&materials) {}

  /// Its fields and stages, once pressures are those of the densities; where walls are open, after the wall slopes.
  void add_to(Builder& builder) const;

  void reserve(Reduction& reduction) override;
  [[nodiscard]] double start(const decomp::Comm& comm, Particles& particles, GlobalState& global) override;
  [[nodiscard]] bool report(const StepState& state, Reduction& reduction) override;
  [[nodiscard]] double longest_step(const Reduction& reduction) const override;
  void guard_step(const Reduction& reduction, const GlobalState& global) const override;

 private:
  struct Fastest {
    double conductance = 0, stiffness = 0;  ///< k b [s], and of gas_stiffness() [m^2/s^2]
    void see(double of_conductance, double of_stiffness);
  };
  [[nodiscard]] Fastest at_start(const Particles& particles) const;
  [[nodiscard]] double limit(const Fastest& found) const;

  const SphConstants* constants_;
  const Materials* materials_;
  std::shared_ptr<ContentChange> change_ = std::make_shared<ContentChange>();
  struct Places {
    Reduction::Maximum conductance, stiffness, change, content, dt;  ///< the last three of implicit flow
  };
  Places in_{};  ///< the reduction
};

}  // namespace sph
