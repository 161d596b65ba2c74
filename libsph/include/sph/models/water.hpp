// Water that diffuses in the melt that it is dissolved in (group.water_diffusivity): between particles of fixed liquid
// mass M, pair by pair (terms/water_diffusion.hpp). What one gains adds to its w and to its volatiles m alike, in the
// volume that it has: mass, density and pressure follow, and what is in bubbles, m - w, stays. So
//   sum M m is what it was, but for rounding, and w between the least and the largest of before
// in steps of dt <= 0.15 h^2 / D: twice that is positive on a lattice where all is alike, and foam beside melt that is
// much denser takes in water twice as fast. Of groups whose w is state alone (exsolution_time): in equilibrium w is a
// function of the pressure, and between bubbles that keep it so water has a shorter way than between particles.
#pragma once

#include "sph/models/builder.hpp"
#include "sph/models/model.hpp"

namespace sph {

/// Of diffusion, 0 if there is none [s]; a pure function of the scene.
[[nodiscard]] double longest_water_step(const Scene& scene);
/// Throws InputError where time.dt is longer.
void check_water_step(const Scene& scene);

class Water final : public Model {
 public:
  Water(std::size_t set, const SphConstants& constants, const Materials& materials)
      : Model(set), constants_(&constants), materials_(&materials) {}

  /// Its fields and stages, once pressures are those of the densities.
  void add_to(Builder& builder) const;

  [[nodiscard]] double start(const decomp::Comm& comm, Particles& particles, GlobalState& global) override;
  [[nodiscard]] bool report(const StepState&, Reduction&) override { return true; }
  [[nodiscard]] double longest_step(const Reduction& reduction) const override;

 private:
  const SphConstants* constants_;
  const Materials* materials_;
};

}  // namespace sph
