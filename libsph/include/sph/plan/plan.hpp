// What a scene's step does: positions drift, lists are made anew if they must be, sums are taken where
// particles then are, velocities are kicked.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "sph/plan/stage.hpp"

namespace sph {

/// A start that stages approach by repetition, lists being made anew after each time, until it changes no more
/// but by rounding.
class Settling {
 public:
  virtual ~Settling() = default;
  virtual void prepare(Particles& particles) = 0;
  /// The largest change of what has settled, relative to itself.
  [[nodiscard]] virtual double change(const Particles& particles) const = 0;
  FieldSet prepares;  ///< what prepare() changes
  FieldSet settles;   ///< what the lists must know
};

struct Plan {
  std::vector<Entry> drift;            ///< before lists are looked at
  std::vector<Entry> sums;             ///< over pairs, each with what follows from it for a particle alone
  std::vector<Entry> kick;             ///< what moves particles last
  std::vector<Entry> start;            ///< of `sums`: what the first step wants done
  std::vector<Entry> settle;           ///< ... what a start is to be brought into balance with
  std::shared_ptr<Settling> settling;  ///< where `settle` is repeated
  bool half_kick = false;  ///< velocities of the start are those of its time: half a kick comes first
};

/// Appends a stage that is no loop.
inline void append(std::vector<Entry>& entries, Stage stage) {
  entries.push_back({{std::move(stage)}, {}, {}});
}

/// The end where there is none.
[[nodiscard]] std::vector<Entry>::const_iterator first_that_writes(const std::vector<Entry>& entries,
                                                                   Field field);

/// All entries of a step in their order.
[[nodiscard]] std::vector<const Entry*> entries_of(const Plan& plan);
/// Bound on the path of any particle of a set in the next step, or in some entries of it [m].
[[nodiscard]] double longest_move(const Plan& plan, std::size_t set, const GlobalState& global);
[[nodiscard]] double longest_move(const std::vector<Entry>& entries, std::size_t set,
                                  const GlobalState& global);
/// Does a step move particles before it looks at lists?
[[nodiscard]] bool may_drift(const Plan& plan);
/// Adds the plan of a model.
void append(Plan& plan, Plan more);
/// ... whose particles are those of `set`.
void append(Plan& plan, Plan more, std::size_t set);

/// Which halo copies are up to date.
class Freshness {
 public:
  [[nodiscard]] FieldSet missing(FieldSet wanted) const { return wanted.without(fresh_); }
  void sent(FieldSet fields) { fresh_ |= fields; }
  void changed(FieldSet fields) { fresh_ = fresh_.without(fields); }

 private:
  FieldSet fresh_;
};

/// A stage in a step in the middle of a run, without a rebuild of lists.
struct Scheduled {
  const Entry* entry;
  const Stage* stage;
  FieldSet sends;        ///< to the halo before it
  FieldSet again;        ///< ... in each further iteration of its loop
  FieldSet other_sends;  ///< to the halo of its other set
};
/// `fields`: those that each set of particles has.
[[nodiscard]] std::vector<Scheduled> schedule_of(const Plan& plan, std::span<const FieldSet> fields);

}  // namespace sph
