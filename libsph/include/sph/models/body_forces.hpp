// What accelerates a particle besides its pairs: gravity, on matter that is lighter where it is warm (Boussinesq:
// g (1 - alpha (T - T_0))), less what a background bears (laws/background.hpp), a central pull, grains in the fluid as
// far as known from the step before (models/drag.hpp), what a caller gives (step/plan_runner.hpp), and, beside a free surface where particles
// are shifted, the control of tension.
#pragma once

#include <optional>

#include "sph/models/sph_constants.hpp"
#include "sph/models/surface_gradient.hpp"
#include "sph/plan/stage.hpp"

namespace sph {

class BodyForces {
 public:
  static constexpr FieldSet reads{Field::position, Field::pressure,   Field::density,     Field::mass,
                                  Field::spread,   Field::grain_pull, Field::temperature, Field::group};
  using Particles = View<reads, FieldSet{}>;

  explicit BodyForces(const SphConstants& constants);

  /// What accelerates all particles alike, where nothing else does [m/s^2].
  [[nodiscard]] std::optional<Double3> common(const Particles& particles, const Step& step) const;
  /// [m/s^2]
  [[nodiscard]] Double3 operator()(const Particles& particles, std::size_t row, const Step& step) const;
  /// How much of a particle's gradient of concentration is not that of a free surface near it.
  [[nodiscard]] double disordered_share(const Particles& particles, std::size_t row) const;

 private:
  [[nodiscard]] double tension_control(const Particles& particles, std::size_t row) const;

  const SphConstants* constants_;
  SurfaceGradient surface_;
  bool expands_;  ///< some matter is lighter where it is warm
};

}  // namespace sph
