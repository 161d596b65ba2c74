#include "sph/step/plan_runner.hpp"

#include "sph/core/error.hpp"

namespace sph {

StepState PlanRunner::state_of(std::size_t set, GlobalState& global, std::optional<std::size_t> other) {
  ParticleSet& of = sets_[set];
  const bool sums = parts_.sph_pairs && parts_.sph_pairs->set() == set;
  std::size_t before = 0;
  for (std::size_t k = 0; k < set; ++k) before += sets_[k].particles.owned();
  const auto dim = static_cast<std::size_t>(of.particles.dim());
  return {{of.ranges, global, maxima_, findings_, given_.empty() ? nullptr : given_.data() + dim * before},
          of.particles,
          other ? &sets_[*other].particles : nullptr,
          sums ? &parts_.sph_pairs->lists() : nullptr,
          rows_};
}

void PlanRunner::ask(const Accelerate& accelerate, double time) {
  given_.clear();
  if (!accelerate) return;
  std::size_t numbers = 0;
  for (const ParticleSet& set : sets_)
    numbers += static_cast<std::size_t>(set.particles.dim()) * set.particles.owned();
  given_.resize(numbers);
  accelerate(time, given_);
}

void PlanRunner::run(const std::vector<Entry>& entries, GlobalState& global) {
  for (const Entry& entry : entries) {
    int iteration = 0;
    do {
      for (const Stage& stage : entry.stages) {
        StepState state =
            state_of(stage.set, global, stage.other ? std::optional(stage.other->set) : std::nullopt);
        state.iteration = iteration;
        run(stage, state);
      }
      ++iteration;
    } while (entry.solver && improve(entry, global));
  }
}

void PlanRunner::run(const Stage& stage, StepState& state) {
  findings_.begin_stage();
  ParticleSet& set = sets_[stage.set];
  const auto work = [&](Side side) {
    const auto timing = timers_.time(stage.region);
    stage.work(state, side);
  };
  ParticleSet* other = stage.other ? &sets_[stage.other->set] : nullptr;
  if (stage.in_lines) {
    const auto timing = timers_.time(stage.region);
    (void)set.particles.lines();
  }
  if (stage.refresh.empty() && other == nullptr) {
    work(Side::all);
  } else {
    set.exchange.begin(set.halo, set.particles, stage.refresh, timers_, stage.in_lines);
    if (other != nullptr) other->exchange.begin(other->halo, other->particles, stage.other->refresh, timers_);
    work(Side::interior);
    set.exchange.end(set.halo, timers_);
    if (other != nullptr) other->exchange.end(other->halo, timers_);
    work(Side::boundary);
  }
  if (stage.moves) age_.add(stage.set, stage.moves(state.global));
  set.changed(stage.writes);
}

// Are the stages of the loop to be run once more? Where a solver gives up, which all ranks do alike, what
// earlier stages have found is the reason.
bool PlanRunner::improve(const Entry& loop, GlobalState& global) {
  const std::size_t set = loop.stages.front().set;
  StepState state = state_of(set, global);
  const auto products = [&] {
    const auto timing = timers_.time(decomp::Region::update);
    return loop.solver->products(state);
  }();
  {
    const auto timing = timers_.time(decomp::Region::reduce);
    decomp::ExactSum::all_reduce(comm_, products);
  }
  const auto timing = timers_.time(decomp::Region::update);
  const bool again = [&] {
    try {
      return loop.solver->improve(state);
    } catch (const GuardError&) {
      findings_.stop(comm_);
      throw;
    }
  }();
  sets_[set].changed(loop.improves);
  if (again) ++counters_.repeats;
  if (again && !products.empty()) ++counters_.iterations;
  if (!again) ++counters_.solved;
  return again;
}

}  // namespace sph
