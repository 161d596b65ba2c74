// Rigid bodies: solids whose particles move as a whole, with six degrees of freedom (in 2D three). A body's particles are
// total-Lagrangian ones without bonds: fluids see a wall that moves (terms/wetted.hpp), other bodies and walls touch it
// (terms/body_contact.hpp). The sum of what they feel travels in the reduction of the step and kicks the body, in the
// phase in which other particles are kicked; the next drift puts the particles where the body has them
// (rigid_motion.hpp): the shape stays to the quantum, whatever the number of steps.
#pragma once

#include <vector>

#include "sph/models/body_sums.hpp"
#include "sph/models/builder.hpp"
#include "sph/models/model.hpp"
#include "sph/models/sph_time_step.hpp"

namespace sph {

class RigidBodies final : public Model {
 public:
  RigidBodies(std::size_t set, const SphConstants& constants, const BodyForces& body_forces);

  /// Puts the particles where the bodies have gone.
  void add_to(Builder& builder) const;

  void reserve(Reduction& reduction) override;
  [[nodiscard]] double start(const decomp::Comm& comm, Particles& particles, GlobalState& global) override;
  [[nodiscard]] bool report(const StepState& state, Reduction& reduction) override;
  void act(const Reduction& reduction, GlobalState& global) override;
  [[nodiscard]] FieldSet follow(Particles& particles, const GlobalState& global) const override;
  [[nodiscard]] double longest_step(const Reduction& reduction) const override;
  void guard_step(const Reduction& reduction, const GlobalState& global) const override;
  [[nodiscard]] double longest_look_back(const GlobalState& global) const override;

 private:
  [[nodiscard]] std::size_t components() const;  ///< of a force and a torque
  void kick(std::size_t body, BodyState& state, double time, double dt) const;
  void note_maxima(const GlobalState& global);
  [[nodiscard]] double longest_step() const;                            ///< after that
  [[nodiscard]] double farthest_move(const GlobalState& global) const;  ///< of a particle in a step [m]
  [[nodiscard]] std::string name_of(std::size_t body) const;

  const SphConstants* constants_;
  const BodyForces* body_forces_;
  SphTimeStep steps_;
  std::vector<int> body_of_;                ///< of each group, -1 if none
  std::vector<const RigidMaterial*> kind_;  ///< of each body
  BodySums forces_, torques_;
  double
      twist_;  ///< what a spin takes of a particle's torque, for the sum that says where the fluid beside it is
  Reduction::Sums in_;                ///< the reduction
  double fastest_ = 0, hardest_ = 0;  ///< of all particles of bodies, after the last act() [m/s], [m/s^2]
};

}  // namespace sph
