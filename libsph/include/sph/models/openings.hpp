// Where fluid comes in and leaves: [[inlet]], [[outlet]], domain.leaves. What is in the box of an inlet flows as the
// scene says, its pressure is that of the free fluid near it (Shepard's mean of what a kernel reaches, with the head
// between, as walls have it) or the other way round; its volume is that of a lattice. What passes the end of
// the box at the end of a step is free from then on, and another particle, with what it has, follows at the box's
// beginning: its id is that of its forerunner + id_stride, so that it depends on no rank, and rows of ids never meet.
// What is in the box of an outlet with a pressure p_o carries its waves on (p + rho c u as near it, u along the box),
// and lets in none: p - rho c u stays, but for what brings p back to p_o in settle_time (Poinsot & Lele 1992).
// What is gone or new, and how much of all that budgets count, follows from the state at the end of a step alone.
#pragma once

#include <cstdint>
#include <vector>

#include "sph/models/builder.hpp"
#include "sph/models/model.hpp"

namespace sph {

/// lower <= x < upper
[[nodiscard]] inline bool contains(const Double3& lower, const Double3& upper, const Double3& x,
                                   std::size_t dim) {
  bool inside = true;
  for (std::size_t a = 0; a < dim; ++a) inside = inside && x[a] >= lower[a] && x[a] < upper[a];
  return inside;
}

class Openings final : public Model {
 public:
  Openings(std::size_t set, const SphConstants& constants, const Materials& materials);

  /// Pressures of what is in boxes, once all others are known.
  void add_to(Builder& builder);
  /// At the end of a step, where particles are then.
  void add_end_to(Builder& builder);

  void reserve(Reduction& reduction) override;
  [[nodiscard]] double start(const decomp::Comm& comm, Particles& particles, GlobalState& global) override;
  [[nodiscard]] bool report(const StepState& state, Reduction& reduction) override;
  void act(const Reduction& reduction, GlobalState& global) override;
  [[nodiscard]] bool turns_over(const Reduction& reduction) const override {
    return reduction[in_.events][0] > 0;
  }
  [[nodiscard]] double turn_over(const decomp::Comm& comm, ParticleSet& set, GlobalState& global) override;

  static constexpr FieldSet reads = FaultView::reads | RangeView::reads | Materials::reads;
  static constexpr FieldSet writes =
      Materials::writes | FieldSet{Field::buffer,     Field::velocity,      Field::density,
                                   Field::mass,       Field::group,         Field::gas_content,
                                   Field::enthalpy,   Field::temperature,   Field::heat_inflow,
                                   Field::gas_inflow, Field::dissolved_gas, Field::liquid_mass};
  using Rows = View<reads, writes>;
  /// The stage of add_end_to.
  void end_step(const Rows& particles, const Step& step);

 private:
  /// A row, and the passage through which it goes or comes.
  struct Event {
    std::size_t row, passage;
  };
  /// Of what is near a row.
  struct Near {
    double weight = 0, pressure = 0;
    double before = 0, speed = 0;  ///< of what is straight before or behind it: weight, velocity along the axis
    double along = 0, square = 0, slope = 0;  ///< of ways along the box's axis; of these and pressures
  };
  /// A box in quanta.
  struct Box {
    std::size_t axis = 0;
    std::int64_t end = 0, length = 0;
    double sign = 1;  ///< of the direction
    [[nodiscard]] bool is_past(std::int64_t x) const { return sign > 0 ? x >= end : x < end; }
  };

  [[nodiscard]] Box box_of(const std::array<double, 3>& lower, const std::array<double, 3>& upper,
                           Direction direction) const;
  [[nodiscard]] Double3 place(const Rows& particles, std::size_t row) const;
  [[nodiscard]] double speed(const Inlet& inlet, std::size_t number, const Double3& at, double time,
                             const GlobalState& global) const;
  [[nodiscard]] double head(const Double3& from, const Double3& to, std::uint32_t group,
                            double density) const;
  template <class Function>
  void for_buffers(const StepState& state, Side side, Function function) const;
  [[nodiscard]] const Box& box(std::size_t number) const {
    return number < inlets_.size() ? inlets_[number] : outlets_[number - inlets_.size()];
  }
  /// An inlet whose pressure is given.
  [[nodiscard]] bool is_pressed(std::size_t number) const;
  [[nodiscard]] Near near(const StepState& state, std::size_t row, std::size_t block, std::size_t lane) const;
  /// The pressure of what is near, where the row is.
  [[nodiscard]] double pressure_of(const Near& near, std::size_t number, const GlobalState& global) const;
  void sum_up(const Near& near, std::size_t number);
  void pass_pressures(StepState& state, Side side);
  void press(StepState& state, std::size_t row, double pressure, bool keeps_mass) const;
  void let_out(StepState& state, std::size_t row, const Near& near) const;
  void lead(const Rows& particles, std::size_t row, const Step& step) const;
  void renew(const Rows& particles, std::size_t row, const Inlet& inlet, const Step& step) const;
  void judge(const Rows& particles, std::size_t row, const Step& step);
  void check_inlets(const decomp::Comm& comm, const Particles& particles) const;
  void replace_rows(Particles& particles, const GlobalState& global) const;
  [[nodiscard]] double wanted(const TimeCurve& pressure, const Double3& lower, const Double3& upper,
                              const Rows& particles, std::size_t row, const Step& step) const;

  const SphConstants* constants_;
  const Materials* materials_;
  double sound_ = 0, impedance_ = 0;  ///< of the fastest fluid [m/s], times its density [kg/m^2/s]
  std::vector<Box> inlets_, outlets_;
  std::vector<Event> gone_, come_;  ///< of this rank, in the step at hand
  std::vector<std::int64_t> sums_;  ///< of what is beside each box, whole parts: two each, for their ratio
  struct Places {
    Reduction::Sums events, flows;
  };
  Places in_;  ///< the reduction
};

}  // namespace sph
