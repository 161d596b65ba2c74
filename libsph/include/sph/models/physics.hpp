// A scene of fluids and solids: the models it is made of, its time step, and what it says at the end of a
// step. Nothing here knows about ranks.
#pragma once

#include <optional>
#include <vector>

#include "sph/models/model.hpp"
#include "sph/models/sph_stages.hpp"
#include "sph/models/sph_time_step.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

class Physics final : public Model {
 public:
  Physics(std::size_t set, const Scene& scene, const PositionScale& scale);
  Physics(const Physics&) = delete;  // its stages hold on to it
  Physics& operator=(const Physics&) = delete;

  void reserve(Reduction& reduction) override;
  [[nodiscard]] double start(const decomp::Comm& comm, Particles& particles, GlobalState& global) override;
  void derive(Particles& particles) const override;
  void check_start(const decomp::Comm& comm, const StepState& state) const override;
  [[nodiscard]] bool report(const StepState& state, Reduction& reduction) override;
  [[nodiscard]] double longest_step(const Reduction& reduction) const override;
  void guard_step(const Reduction& reduction, const GlobalState& global) const override;
  [[nodiscard]] double longest_look_back(const GlobalState& global) const override;
  [[nodiscard]] double growth(const Reduction& reduction) const override { return reduction[in_.growth]; }
  [[nodiscard]] double speed_limit() const override;
  [[nodiscard]] std::vector<Energy> energies() const override;
  void add_energies(const Particles& particles, EnergySums& sums) const override;

  /// Its fields and stages.
  [[nodiscard]] const Builder& built() const { return builder_; }
  [[nodiscard]] const SphConstants& constants() const { return constants_; }
  [[nodiscard]] const SphTimeStep& steps() const { return steps_; }
  /// Models of its own.
  [[nodiscard]] SphModels& models() { return models_; }
  [[nodiscard]] GasReach* reach() { return reach_ ? &*reach_ : nullptr; }

 private:
  [[nodiscard]] StepMaxima maxima_at_start(Particles& particles) const;
  void look_at_viscosities(const Particles& particles, StepMaxima& maxima) const;

  const Scene* scene_;
  bool gas_;               ///< there is an ideal gas
  bool bubbly_;            ///< there is a bubbly fluid
  bool stiffens_ = false;  ///< some sound speed grows with the pressure
  SphConstants constants_;
  Materials materials_;
  BodyForces body_forces_;
  Builder builder_;
  SphModels models_;
  SphTimeStep steps_;
  std::optional<GasReach> reach_;
  struct Places {
    Reduction::Maximum sound, viscosity, bulk, growth;
  };
  Places in_;  ///< the reduction
};

}  // namespace sph
