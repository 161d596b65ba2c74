// The step as data: stages in their order, some of them in loops. A stage says which fields of neighbours it
// reads and which fields it writes; from that alone follows which halo copies are brought up to date before
// it (plan.hpp), so a declaration that is missing shows as other bits on other ranks, never as a habit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "decomp/exact_sum.hpp"
#include "decomp/memory.hpp"
#include "decomp/timer.hpp"
#include "sph/core/fields.hpp"
#include "sph/core/findings.hpp"
#include "sph/core/particles.hpp"
#include "sph/pairs/sph_lists.hpp"
#include "sph/plan/view.hpp"

namespace sph {

struct Fusion;

/// Maxima that travel in the step's one reduction; part of the state where the next step depends on them.
struct StepMaxima {
  double speed = 0;         ///< [m/s]
  double acceleration = 0;  ///< [m/s^2]
  std::int64_t volume = 0;  ///< of this rank's fluid, see FluidVolume; a sum
  double sound = 0;         ///< of ideal gases; 0: not looked at yet [m/s]
  double viscosity =
      0;            ///< eta / rho of gases, bubbly fluids and those with a law; 0: not looked at yet [m^2/s]
  double bulk = 0;  ///< ... and zeta / rho [m^2/s]
  MotionSums motion{};  ///< of this rank's particles that move
};

/// What a local update knows besides its fields (view.hpp).
struct Step {
  const RowRanges& ranges;
  GlobalState& global;
  StepMaxima& maxima;  ///< of this step, set by what moves particles last
  Findings& findings;  ///< what no particle may be: the run stops at the end of the step
  /// Accelerations of the owned rows that a caller gives, [row][component]; null: none [m/s^2].
  const double* given = nullptr;
};

/// What the stages of a step work on: one rank's part of a scene.
struct StepState : Step {
  Particles& particles;
  Particles* other;                      ///< of the other set of a stage that looks at two
  SphLists* lists;                       ///< of a set of fluids and solids
  decomp::LargeVector<std::byte>& rows;  ///< scratch of sums over pairs
  int iteration = 0;                     ///< of the loop that the stage is in
};

/// Rows of the interior have no partner in the halo: they are computed while messages travel.
enum class Side : std::uint8_t { all, interior, boundary };

/// A stage that reads no neighbours is asked once, for all rows; others first for the interior.
struct Stage {
  std::string name;
  decomp::Region region = decomp::Region::update;
  FieldSet refresh;  ///< read of neighbours: up to date in the halo before the boundary is computed
  FieldSet writes;   ///< halo copies of these are out of date after it
  std::function<void(StepState&, Side)> work;
  std::function<double(const GlobalState&)> moves{};  ///< bound on any particle's path in it [m]; empty: 0
  const Fusion* fusion = nullptr;                     ///< of a stage that sums over pairs
  std::size_t set = 0;                                ///< of particles, as an index
  bool in_lines = false;                              ///< its grains are in lines (core/grain_lines.hpp)
  /// Another set whose neighbours it reads.
  struct Other {
    std::size_t set;
    FieldSet refresh;
  };
  std::optional<Other> other{};
};

/// A local update: `update(view, step)` of what it declares as `reads` and `writes`.
template <class Update>
[[nodiscard]] Stage local_stage(std::string name, Update update) {
  return {std::move(name),
          decomp::Region::update,
          {},
          Update::writes,
          [update = std::move(update)](StepState& s, Side) { update(ViewOf<Update>(s.particles), s); }};
}

/// Decides how often the stages of a loop are run.
class Solver {
 public:
  virtual ~Solver() = default;
  /// This rank's part of the dot products of an iteration, to be summed over all ranks; none: nothing to sum.
  [[nodiscard]] virtual std::span<decomp::ExactSum> products(const StepState& state) = 0;
  /// Sets what the next iteration reads and says true, or finishes and says that it was the last.
  [[nodiscard]] virtual bool improve(StepState& state) = 0;
};

/// Stages that are repeated until their solver is content. One stage stands for a loop that runs once.
struct Entry {
  std::vector<Stage> stages;
  std::shared_ptr<Solver> solver;  ///< of a loop; else empty
  FieldSet improves;               ///< fields the solver changes
};

}  // namespace sph
