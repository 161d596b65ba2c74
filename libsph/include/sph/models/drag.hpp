// Grains in a fluid, both averaged over the kernel (Anderson & Jackson 1967; Robinson, Ramaioli & Luding 2014,
// with the pressure shared by both: model A of Gidaspow 1994). Where grains leave the share e of the volume, the
// porosity, to the fluid, its density rho is that of its mass in all of the volume, and its pressure follows
// from rho / e:
//   e_a = 1 - sum_i V_i W_ai / O_a                                                      at fluid particles a
//   F_i = b_i [V_i theta_i + zeta_i (u_i - v_i)]                                        on grains i
//   theta_i = sum_a F_a W_ai / S_i, u_i = sum_a V_a u_a W_ai / S_i, S_i = sum_a V_a W_ai, V_a = m_a / rho_a,
// F_a the forces of the fluid on its particle, pressure and viscosity; zeta is that of the drag law (laws/drag/law.hpp);
// O_a is what walls leave of the kernel; b_i is 1, less for grains that are partly above the fluid. The fluid gets
// -F_i V_a W_ai / S_i. These are sums of integers, so that momentum is conserved exactly and no order matters.
// The fluid is kicked with what grains pulled at it in the step before (body_forces.hpp), which implicit viscosity
// then spreads; drag is taken with that velocity of the fluid, and with the v_i that a grain has after it; what has
// changed of the pull comes on top. Without that guess a fluid that is driven through grains would be dragged as if it
// were faster than it is.
#pragma once

#include <cstdint>
#include <vector>

#include "decomp/memory.hpp"
#include "sph/models/drag_force.hpp"
#include "sph/models/fluid_near.hpp"
#include "sph/models/model.hpp"
#include "sph/models/sph_constants.hpp"
#include "sph/pairs/set_pair.hpp"

namespace sph {

class Drag final : public Model, public SetPair {
 public:
  static constexpr FieldSet of_fluid{Field::porosity, Field::liquid_density, Field::grain_pull,
                                     Field::grain_drag};
  static constexpr FieldSet of_grains{Field::fluid_force, Field::fluid_drag, Field::fluid_share};

  Drag(std::size_t fluid, std::size_t grains, const Scene& scene, const PositionScale& scale,
       const SphConstants& constants);
  Drag(const Drag&) = delete;  // its stages hold on to it
  Drag& operator=(const Drag&) = delete;

  /// The fluid's densities and pressures want the porosity; so does its start, where it has been placed as if it had
  /// all of the volume.
  void add_porosity_to(Plan& fluid);
  /// After all other forces.
  [[nodiscard]] Plan force_plan();

  /// The longest time step in a packed bed [s].
  [[nodiscard]] double bed_step() const { return first_step_; }

  // As a model.
  void reserve(Reduction& reduction) override {
    rate_ = reduction.add_maximum();
    sound_ = reduction.add_maximum();
  }
  [[nodiscard]] double start(const decomp::Comm&, Particles&, GlobalState&) override;
  [[nodiscard]] bool report(const StepState&, Reduction& reduction) override;
  [[nodiscard]] double longest_step(const Reduction& reduction) const override;
  void guard_step(const Reduction& reduction, const GlobalState& global) const override;

  // As a pair of sets: of each grain, those of the halo included, the fluid around it.
  [[nodiscard]] std::size_t set() const { return Model::set(); }
  [[nodiscard]] FieldSet constants() const override { return {Field::id, Field::position, Field::radius}; }
  void rebuild(const Particles& grains, const ListSetting& setting, decomp::Payload&,
               std::span<const std::uint32_t>) override {
    near_.rebuild(grains, setting);
  }
  void count(const RowRanges&, std::span<std::uint32_t> entries) const override {
    for (std::size_t i = 0; i < entries.size(); ++i)
      entries[i] += static_cast<std::uint32_t>(near_.listed(i));
  }

 private:
  template <class Function>
  void for_grains(const Particles& grains, Side side, Function function) const;

  void deposit_porosity(StepState& s, Side side);
  void fill_between_grains(const StepState& s) const;
  void push_grains(StepState& s, Side side);
  void push_fluid(StepState& s, Side side);
  [[nodiscard]] double step_of(const PushLimits& limits) const;
  [[nodiscard]] double quanta_a_weight(double force, double share) const;

  const Scene* scene_;
  const SphConstants* constants_;
  DragForce push_;
  FluidNear near_;
  bool fluid_is_displaced_ = false;  ///< after its porosity was found, by shifting
  double force_quantum_;
  double first_step_;
  Reduction::Maximum rate_{}, sound_{};
  PushLimits limits_;                           ///< of this step
  decomp::LargeVector<std::int64_t> deposits_;  ///< of each fluid particle
};

}  // namespace sph
