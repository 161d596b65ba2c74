// Boxes in which particles get another state at the end of each step ([[reset]]): hot or gas-rich matter comes in where a
// period, or a flow, has brought old matter round. Of a particle in a box
//   the temperature becomes T, its enthalpy H(T), at constant mass;
//   the pressure p, at constant volume: mass comes in, of the matter that is there, or leaves;
//   the mass grows by its share of what is to come in, at constant volume, of the matter that is there: that is what a pump
//   at a given rate does. All fluid particles in the box have the same share. How many there are is known of the step before; what
//   a change of their number leaves over comes in with the next steps, after `until` too. Particles grow by it and are not split;
//   the gas content m, its mass M (1 + m), M that of its liquid, at constant temperature, velocity and pressure: the
//   density follows, and the volume. What can be dissolved is, where that takes time. (At constant volume gas that comes in would be a blow.)
// What heat, gas and other mass that adds is counted for the particle (heat_inflow, gas_inflow, mass_inflow); its momentum grows as its mass does.
#pragma once

#include <vector>

#include "sph/laws/eos/law.hpp"
#include "sph/models/builder.hpp"
#include "sph/models/model.hpp"

namespace sph {

/// Boxes with another gas content: particles count what they get.
[[nodiscard]] bool resets_gas(const Scene& scene);

class Resets final : public Model {
 public:
  static constexpr FieldSet reads =
      FaultView::reads | RangeView::reads | Materials::reads | FieldSet{Field::buffer};
  static constexpr FieldSet writes =
      Materials::writes | FieldSet{Field::density,    Field::mass,          Field::gas_content,
                                   Field::enthalpy,   Field::temperature,   Field::heat_inflow,
                                   Field::gas_inflow, Field::dissolved_gas, Field::liquid_mass,
                                   Field::mass_inflow};
  using Rows = View<reads, writes>;

  Resets(std::size_t set, const SphConstants& constants, const Materials& materials);
  /// After transitions, which are judged by what the step has made.
  void add_to(Builder& builder);

  void reserve(Reduction& reduction) override;
  [[nodiscard]] double start(const decomp::Comm& comm, Particles& particles, GlobalState& global) override;
  [[nodiscard]] bool report(const StepState& state, Reduction& reduction) override;
  void guard(const decomp::Comm& comm, const StepState& state, const Reduction& reduction) const override;
  void act(const Reduction& reduction, GlobalState& global) override;

  /// The stage.
  void end_step(const Rows& particles, const Step& step);

 private:
  /// A box, and which of GlobalState::inflows is its own.
  struct Box {
    const Reset* reset;
    std::optional<std::size_t> inflow;
  };
  /// What is to come in with the step at hand [kg].
  [[nodiscard]] static double due(const Box& box, const GlobalState& global);
  /// ... into each of those that were in the box in the step before.
  [[nodiscard]] static double share(const Box& box, const GlobalState& global);
  [[nodiscard]] bool is_led(const Rows& particles, std::size_t row) const;
  [[nodiscard]] bool is_fluid(std::uint32_t group) const;
  template <class V>
  [[nodiscard]] bool contains(const Reset& box, const V& particles, std::size_t row) const;
  void fill(const Rows& particles, std::size_t row, double content, const Step& step) const;
  void heat(const Rows& particles, std::size_t row, double wanted) const;
  void raise(const Rows& particles, std::size_t row, const Reset& box, const Step& step) const;
  void press(const Rows& particles, std::size_t row, double wanted, const Step& step) const;
  void receive(const Rows& particles, std::size_t row, const Box& box, const Step& step);
  void grow(const Rows& particles, std::size_t row, double density, const Step& step) const;

  const SphConstants* constants_;
  const Materials* materials_;
  std::vector<Box> boxes_;
  std::vector<std::int64_t> received_;  ///< of this rank, by inflow: particles in the step at hand
  Reduction::Sums in_;                  ///< the reduction
};

}  // namespace sph
