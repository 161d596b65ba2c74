// Shifting: particles are moved against the gradient S of their concentration (terms/shifting.hpp), by
//   delta r = -2 h U dt S, at most U dt / 2 long,
// the form of Sun et al. (2017), where U is the largest speed of the flow. Here it is local, the same in
// every frame, and 0 in rigid motion: U_i = min(256 w_i, 2 M, c / 10), w_i the rms speed at which a particle
// and its neighbours part, M = (mean of |v - mean v|^8)^(1/8) over all, the largest but for what few do.
#pragma once

#include "sph/models/builder.hpp"
#include "sph/models/model.hpp"

namespace sph {

class Shifting final : public Model {
 public:
  static constexpr FieldSet reads =
      BodyForces::reads | FieldSet{Field::id, Field::group, Field::sound_speed, Field::buffer};
  static constexpr FieldSet writes{Field::position};
  /// What the sums of all particles need.
  using Motion = View<FieldSet{Field::velocity, Field::group, Field::mass, Field::density}, FieldSet{}>;

  Shifting(std::size_t set, const SphConstants& constants, const BodyForces& body_forces)
      : Model(set), constants_(&constants), body_forces_(&body_forces) {}
  Shifting(const Shifting&) = delete;  // its stages hold on to it
  Shifting& operator=(const Shifting&) = delete;

  void add_to(Builder& builder) const;
  /// What all particles do together, after whatever changes one of them.
  void add_motion_to(Builder& builder) const;

  void reserve(Reduction& reduction) override;
  [[nodiscard]] double start(const decomp::Comm& comm, Particles& particles, GlobalState& global) override;
  [[nodiscard]] bool report(const StepState& state, Reduction& reduction) override;
  void act(const Reduction& reduction, GlobalState& global) override;

  /// Bound on how far it moves any particle, from what is known at the start of the step [m].
  [[nodiscard]] double longest(const GlobalState& global) const;
  void shift(const View<reads, writes>& particles, const Step& step) const;
  /// Sums of this rank for those of all.
  void sum_up(const Motion& particles, const Step& step) const;

 private:
  /// Of this rank's particles that move; see FluidVolume.
  [[nodiscard]] std::int64_t fluid_volume(const Motion& particles) const;
  /// Of this rank's particles that move, about the mean known before; and what the sums over all ranks say.
  [[nodiscard]] MotionSums motion_sums(const Motion& particles, const GlobalState& global) const;
  [[nodiscard]] CommonMotion common_motion(const MotionSums& found, const GlobalState& global) const;
  [[nodiscard]] double speed_of(const View<reads, writes>&, std::size_t row, const GlobalState&,
                                double rest) const;

  const SphConstants* constants_;
  const BodyForces* body_forces_;
  struct Places {
    Reduction::Maximum unlike;
    Reduction::Sums motion, volume;
  };
  Places in_;  ///< the reduction
};

}  // namespace sph
