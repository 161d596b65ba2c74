// The viscosity of fluids that have a law of it (laws/melt_viscosity.hpp): a field that follows from the state of each
// particle, before the sums that read it. Explicit viscous forces see walls as viscous as the fluid beside them, the mean
// sum V eta W / sum V W; implicit ones as viscous as the particle itself.
#pragma once

#include "sph/models/builder.hpp"
#include "sph/models/faults.hpp"

namespace sph {

/// Some fluid that moves has a law.
[[nodiscard]] bool has_viscosity_law(const Scene& scene);

class Viscosities {
 public:
  static constexpr FieldSet reads =
      FaultView::reads | FieldSet{Field::temperature,   Field::pressure, Field::gas_content,
                                  Field::void_fraction, Field::density,  Field::dissolved_gas};
  static constexpr FieldSet writes{Field::viscosity};
  using Particles = View<reads, writes>;

  explicit Viscosities(const SphConstants& constants) : constants_(&constants) {}

  /// Of rows [first, last), 0 of walls; the largest eta / rho of them [m^2/s].
  double derive(const Particles& particles, std::size_t first, std::size_t last) const;

 private:
  [[nodiscard]] double of(const Particles& particles, std::size_t row) const;

  const SphConstants* constants_;
};

/// Its stages, once pressures are those of the densities.
void add_viscosities(Builder& builder);

}  // namespace sph
