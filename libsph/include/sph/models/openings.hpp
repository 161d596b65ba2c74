// Where fluid comes in and leaves: [[inlet]], [[outlet]], domain.leaves. What passes the end of an inlet's box at the
// end of a step is free from then on, and another particle, with what it has, follows at the box's beginning: its id is
// that of its forerunner + id_stride, a number above all ids of the start, so that no rank has a part in it and no two
// are the same. What passes the end of an outlet's box is no more, nor is what a step leaves in one without a pressure,
// or outside the domain beyond a face that deletes. Who that is, and how much of all that budgets count, follows from
// the state at the end of a step alone.
#pragma once

#include <vector>

#include "sph/models/builder.hpp"
#include "sph/models/model.hpp"
#include "sph/models/opening_boxes.hpp"

namespace sph {

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
  [[nodiscard]] std::optional<double> turn_over(const Distribution& distribution, const Reduction& reduction,
                                                ParticleSet& set, GlobalState& global) override;

  using Rows = OpeningBoxes::Rows;
  /// The stage of add_end_to.
  void end_step(const Rows& particles, const Step& step);

 private:
  /// A row, and the passage through which it goes or comes.
  struct Event {
    std::size_t row, passage;
  };

  void lead(const Rows& particles, std::size_t row, const Step& step) const;
  void renew(const Rows& particles, std::size_t row, const Inlet& inlet, const Step& step) const;
  void judge(const Rows& particles, std::size_t row, const Step& step);
  void judge_led(const Rows& particles, std::size_t row, const Step& step);
  void replace_rows(Particles& particles, const GlobalState& global) const;

  const SphConstants* constants_;
  const Materials* materials_;
  OpeningBoxes boxes_;
  std::vector<Event> gone_, come_;  ///< of this rank, in the step at hand
  struct Places {
    Reduction::Sums events, flows;
  };
  Places in_;  ///< the reduction
};

}  // namespace sph
