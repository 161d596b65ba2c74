// The boxes of inlets and outlets, and what is led in them. In that of an inlet fluid flows as the scene says, under
// the pressure of the free fluid near it: Shepard's mean of what a kernel reaches, with the head between, as walls have
// it, and the mean gradient along the box; or the other way round. Its volume is that of a lattice.
// In that of an outlet with a pressure p_o it carries waves on (p + rho c u as straight before it, u along the
// box) and lets none in: p - rho c u stays, but for what brings p back to p_o in settle_time (Poinsot & Lele 1992).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sph/models/materials.hpp"
#include "sph/models/sph_constants.hpp"
#include "sph/plan/stage.hpp"

namespace sph {

/// A box in quanta.
struct OpeningBox {
  Double3 lower{}, upper{};  ///< [m]
  const TimeCurve* pressure = nullptr;
  std::size_t axis = 0;
  std::int64_t end = 0, length = 0;
  double sign = 1;  ///< of the direction

  [[nodiscard]] bool is_past(std::int64_t x) const { return sign > 0 ? x >= end : x < end; }
  [[nodiscard]] bool contains(const Double3& x, std::size_t dim) const {
    bool inside = true;
    for (std::size_t a = 0; a < dim; ++a) inside = inside && x[a] >= lower[a] && x[a] < upper[a];
    return inside;
  }
};

class OpeningBoxes {
 public:
  static constexpr FieldSet reads = FaultView::reads | RangeView::reads | Materials::reads;
  static constexpr FieldSet writes =
      Materials::writes | FieldSet{Field::buffer,     Field::velocity,      Field::density,
                                   Field::mass,       Field::group,         Field::gas_content,
                                   Field::enthalpy,   Field::temperature,   Field::heat_inflow,
                                   Field::gas_inflow, Field::dissolved_gas, Field::liquid_mass};
  using Rows = View<reads, writes>;

  OpeningBoxes(const SphConstants& constants, const Materials& materials);

  /// Inlets first, then outlets: in the order of passages, a particle's `buffer` being one more.
  [[nodiscard]] std::span<const OpeningBox> all() const { return boxes_; }
  [[nodiscard]] bool is_inlet(std::size_t number) const { return number < inlets_; }
  [[nodiscard]] std::size_t inlets() const { return inlets_; }
  /// In the periodic domain [m].
  [[nodiscard]] Double3 place(const Rows& particles, std::size_t row) const;
  /// What an inlet makes the velocity along its direction at a place [m/s].
  [[nodiscard]] double speed(std::size_t inlet, const Double3& at, double time,
                             const GlobalState& global) const;

  /// Who is led at the start, and how fast. Collective; throws InputError where the box of an inlet has gaps, or fluid is behind it.
  void mark(const decomp::Comm& comm, Particles& particles, const GlobalState& global) const;
  /// The stage that passes pressures on; in the end sums() are those of the step.
  void pass_pressures(StepState& state, Side side);
  /// Of what is beside each box, whole parts: two each, for their ratio.
  [[nodiscard]] std::span<const std::int64_t> sums() const { return sums_; }
  /// What all ranks' sums make of Passage::beside.
  void remember(std::span<const std::int64_t> sums, GlobalState& global) const;

 private:
  /// Of what is near a row.
  struct Near {
    double weight = 0, pressure = 0;
    double before = 0,
           speed = 0;  ///< of what is straight before or behind it: weight, velocity along the axis
    double along = 0, square = 0, slope = 0;  ///< of ways along the box's axis; of these and pressures
  };

  /// An inlet whose pressure is given.
  [[nodiscard]] bool is_pressed(std::size_t number) const;
  [[nodiscard]] double head(const Double3& from, const Double3& to, std::uint32_t group,
                            double density) const;
  [[nodiscard]] Near near(const StepState& state, std::size_t row, std::size_t block, std::size_t lane) const;
  void sum_up(const Near& near, std::size_t number);
  [[nodiscard]] double pressure_of(const Near& near, std::size_t number, const GlobalState& global) const;
  [[nodiscard]] double wanted(const OpeningBox& box, const Rows& particles, std::size_t row,
                              const Step& step) const;
  void let_out(StepState& state, std::size_t row, const Near& near) const;
  void press(StepState& state, std::size_t row, double pressure, bool keeps_mass) const;
  void check_inlets(const decomp::Comm& comm, const Particles& particles) const;
  void check_behind(const decomp::Comm& comm, Particles& particles) const;

  const SphConstants* constants_;
  const Materials* materials_;
  std::size_t inlets_;
  std::vector<OpeningBox> boxes_;
  double sound_ = 0, impedance_ = 0;  ///< of the fastest fluid [m/s], times its density [kg/m^2/s]
  std::vector<std::int64_t> sums_;
};

}  // namespace sph
