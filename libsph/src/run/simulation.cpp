#include "sph/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace sph {

std::int64_t Simulation::step(std::int64_t request) {
  if (global_.step == 0 && scene_.has_eos(EosKind::ideal_gas)) kick_half_a_step();
  maxima_ = {};
  run(plan_.drift);
  if (stale_) rebuild();
  run(plan_.sums);
  run(plan_.kick);
  return finish_step(request);
}

StepState Simulation::state_of_step() {
  return {{distribution_.ranges(), global_, maxima_, findings_}, particles_, sph_pairs_.lists(), rows_};
}

void Simulation::run(const std::vector<Entry>& entries) {
  StepState state = state_of_step();
  run(entries, state);
}

void Simulation::run(const std::vector<Entry>& entries, StepState& state) {
  for (const Entry& entry : entries) {
    state.iteration = 0;
    do {
      for (const Stage& stage : entry.stages) run(stage, state);
      ++state.iteration;
    } while (entry.solver && improve(entry, state));
  }
}

void Simulation::run(const Stage& stage, StepState& state) {
  const auto work = [&](Side side) {
    const auto timing = timers_.time(stage.region);
    stage.work(state, side);
  };
  if (stage.refresh.empty()) {
    work(Side::all);
  } else {
    exchange_.begin(distribution_.halo(), particles_, stage.refresh, timers_);
    work(Side::interior);
    exchange_.end(distribution_.halo(), timers_);
    work(Side::boundary);
  }
  if (stage.moves) moved_ += stage.moves(state.global);
  changed(stage.writes);
}

// Are the stages of the loop to be run once more?
bool Simulation::improve(const Entry& loop, StepState& state) {
  const auto products = [&] {
    const auto timing = timers_.time(decomp::Region::update);
    return loop.solver->products(state);
  }();
  {
    const auto timing = timers_.time(decomp::Region::reduce);
    decomp::ExactSum::all_reduce(comm_, products);
  }
  const auto timing = timers_.time(decomp::Region::update);
  const bool again = loop.solver->improve(state);
  changed(loop.improves);
  if (again) ++counters_.repeats;
  if (again && !products.empty()) ++counters_.iterations;
  if (!again) ++counters_.solved;
  return again;
}

// For tests of the balance: this rank's cores are slower by scene.decomposition.slowness.
void Simulation::add_dawdling() {
  const double slowness = scene_.decomposition.slowness;
  if (slowness <= 1 || scene_.decomposition.slow_rank != comm_.rank()) return;
  append(plan_.kick,
         {"dawdle", decomp::Region::update, {}, {}, [this, slowness, before = 0.0](StepState&, Side) mutable {
            const double until = before + slowness * (timers_.cost() - before);
            while (timers_.cost() < until) {
            }
            before = timers_.cost();
          }});
}

// Velocities are those of half a step later. A gas may start with a jump of its pressure, and accelerations
// are never larger than then: the error of a first step that takes them as they are would stay in its energy.
void Simulation::kick_half_a_step() {
  run(plan_.sums);
  GlobalState part = global_;
  const auto kick = [&](double share) {
    part.dt = share * global_.dt;
    maxima_ = {};
    StepState state{
        {distribution_.ranges(), part, maxima_, findings_}, particles_, sph_pairs_.lists(), rows_};
    run(plan_.kick, state);
    reduce(0, false);
    if (reduction_[Reduction::bad] > 0) stop_at_fault();
    take_maxima();
    physics_.set_step(reduction_, part);
    return part.dt;
  };
  global_.dt = kick(0);  // how large a step may be follows from the accelerations
  (void)kick(0.5);
  find_stale(longest_move(plan_, global_));
}

// Measured cost -> new cuts -> migrate -> sort by (Hilbert key of cell, id) -> halo plan -> neighbour lists.
void Simulation::rebuild() {
  decomp::Payload carried = [&] {
    const auto timing = timers_.time(decomp::Region::lists);
    return pairs_->send(particles_, std::exchange(arrived_, {}));
  }();
  std::vector<std::uint32_t> order;
  {
    const auto timing = timers_.time(decomp::Region::migrate);
    try {
      order = distribution_.rebuild(
          particles_, timers_.take_cost(), [&] { return pairs_of_rows(); }, is_wall_group_, moved_,
          pairs_->least_skin(global_), pairs_->carries() ? &carried : nullptr);
    } catch (const GuardError& error) {
      throw GuardError(step_text(global_.step) + error.what());
    }
    if (decomp::census(comm_, particles_.table(), particles_.column(Field::id)) != census_)
      throw GuardError("step " + std::to_string(global_.step) +
                       ": a particle was lost or duplicated in migration; reduce time.dt");
  }
  exchange_.forget();
  refresh_halo(pairs_->constants());
  pairs_->rebuild(particles_, list_setting(), carried, order);
  moved_ = 0;
  ++counters_.rebuilds;
}

ListSetting Simulation::list_setting() {
  return {comm_,
          distribution_.grid(),
          distribution_.own_cells(),
          distribution_.list_radius(),
          distribution_.skin(),
          distribution_.ranges(),
          global_,
          timers_};
}

std::vector<std::uint32_t> Simulation::pairs_of_rows() const {
  std::vector<std::uint32_t> pairs(particles_.owned(), 0);
  if (counters_.rebuilds > 0) pairs_->count(distribution_.ranges(), pairs);
  return pairs;
}

void Simulation::refresh_halo(FieldSet fields) {
  exchange_.begin(distribution_.halo(), particles_, fields, timers_);
  exchange_.end(distribution_.halo(), timers_);
}

void Simulation::refresh_contacts() {
  if (stale_) rebuild();
  stale_ = false;
  refresh_halo(grains_->reads());
}

// What all ranks must know of this step. What it brings acts in the next one.
void Simulation::reduce(std::int64_t request, bool left) {
  const StepState state = state_of_step();
  reduction_.clear();
  bool finite = std::isfinite(maxima_.speed) && std::isfinite(maxima_.acceleration) && !findings_.any();
  for (Model* m : models_) finite = m->report(state, reduction_) && finite;
  reduction_[Reduction::speed] = finite ? maxima_.speed : 0;
  reduction_[Reduction::acceleration] = finite ? maxima_.acceleration : 0;
  reduction_[Reduction::bad] = finite ? 0 : 1;
  reduction_[Reduction::left] = left ? 1 : 0;
  reduction_[Reduction::request] = static_cast<double>(request);
  {
    const auto timing = timers_.time(decomp::Region::reduce);
    reduction_.combine(comm_);
  }
}

void Simulation::take_maxima() {
  global_.max_speed = reduction_[Reduction::speed];
  global_.max_acceleration = reduction_[Reduction::acceleration];
  growth_ = 0;
  for (const Model* m : models_) growth_ = std::max(growth_, m->growth(reduction_));
}

std::int64_t Simulation::finish_step(std::int64_t request) {
  const Findings left = find_leavers();
  reduce(request, left.any());
  for (const Model* m : models_) m->guard(comm_, state_of_step(), reduction_);
  if (reduction_[Reduction::bad] > 0) stop_at_fault();
  if (reduction_[Reduction::left] > 0) left.stop(comm_, step_text(global_.step));
  for (Model* m : models_) {
    moved_ += m->path(global_, reduction_[Reduction::speed]);
    m->act(reduction_, global_);
  }
  ++global_.step;
  global_.time += global_.dt;
  take_maxima();
  for (const Model* m : models_) {
    m->set_step(reduction_, global_);
    m->guard_step(reduction_, global_);
  }
  find_stale(longest_move(plan_, global_));
  return static_cast<std::int64_t>(reduction_[Reduction::request]);
}

double Simulation::look_back() const {
  double way = 0;
  for (const Model* m : models_) way = std::max(way, m->longest_look_back(global_));
  return way;
}

// A particle that leaves the domain does so in this step, wherever a rebuild would next look at it. Few ranks
// have to look: how far particles were from the faces is known from the last rebuild, and so is a bound on
// their way since.
Findings Simulation::find_leavers() const {
  double step = 0;
  for (const Model* m : models_) step += m->path(global_, maxima_.speed);
  return moved_ + step < distribution_.to_face() ? Findings() : distribution_.outside(particles_);
}

// Lists must hold every pair that a pass of the next step takes, wherever it takes its particles to be: after
// they have moved by `next`, or half a step before that. moved_ bounds every particle's path since the
// rebuild by the largest speed of each step: no positions to remember, and never late. A rebuild in that step
// finds lists that are wide enough for it, however small the scene's skin (rebuild()). Grains are looked at
// again when the bound runs out: one that flies through the sparse part of a scene must not cost rebuilds of
// the rest.
void Simulation::find_stale(double next) {
  guard_motion(next);
  const int every = scene_.decomposition.rebuild_every;
  const bool wanted = growth_ > 1 || (every > 0 && global_.step % every == 0);
  stale_ = wanted || std::max(moved_ + next, look_back()) > 0.5 * distribution_.skin();
  if (!stale_ || wanted) return;
  std::array<double, 1> way{0};
  for (const Model* m : models_) {
    const std::optional<double> looked = m->longest_way(particles_, global_);
    if (!looked) return;
    way[0] = std::max(way[0], *looked);
  }
  const auto timing = timers_.time(decomp::Region::reduce);
  comm_.max(way);
  moved_ = way[0];
  // Another step of the fastest grain must fit, or this look was for nothing.
  stale_ = moved_ + 2 * global_.max_speed * global_.dt > 0.5 * distribution_.skin();
}

}  // namespace sph
