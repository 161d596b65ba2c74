#include "sph/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace sph {

std::int64_t Simulation::step(std::int64_t request) {
  if (global_.step == 0 && scene_.has_eos(EosKind::ideal_gas)) kick_half_a_step();
  united_.reset();
  maxima_ = {};
  run(parts_.plan.drift, global_);
  if (stale_) rebuild();
  run(parts_.plan.sums, global_);
  run(parts_.plan.kick, global_);
  return finish_step(request);
}

StepState Simulation::state_of(std::size_t set, GlobalState& global, std::optional<std::size_t> other) {
  ParticleSet& of = sets_[set];
  const bool sums = parts_.sph_pairs && parts_.sph_pairs->set() == set;
  return {{of.ranges, global, maxima_, findings_},
          of.particles,
          other ? &sets_[*other].particles : nullptr,
          sums ? &parts_.sph_pairs->lists() : nullptr,
          rows_};
}

void Simulation::run(const std::vector<Entry>& entries, GlobalState& global) {
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

void Simulation::run(const Stage& stage, StepState& state) {
  ParticleSet& set = sets_[stage.set];
  const auto work = [&](Side side) {
    const auto timing = timers_.time(stage.region);
    stage.work(state, side);
  };
  ParticleSet* other = stage.other ? &sets_[stage.other->set] : nullptr;
  if (stage.refresh.empty() && other == nullptr) {
    work(Side::all);
  } else {
    set.exchange.begin(set.halo, set.particles, stage.refresh, timers_);
    if (other != nullptr) other->exchange.begin(other->halo, other->particles, stage.other->refresh, timers_);
    work(Side::interior);
    set.exchange.end(set.halo, timers_);
    if (other != nullptr) other->exchange.end(other->halo, timers_);
    work(Side::boundary);
  }
  if (stage.moves) moved_[stage.set] += stage.moves(state.global);
  set.changed(stage.writes);
}

// Are the stages of the loop to be run once more?
bool Simulation::improve(const Entry& loop, GlobalState& global) {
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
  const bool again = loop.solver->improve(state);
  sets_[set].changed(loop.improves);
  if (again) ++counters_.repeats;
  if (again && !products.empty()) ++counters_.iterations;
  if (!again) ++counters_.solved;
  return again;
}

// For tests of the balance: this rank's cores are slower by scene.decomposition.slowness.
void Simulation::add_dawdling() {
  const double slowness = scene_.decomposition.slowness;
  if (slowness <= 1 || scene_.decomposition.slow_rank != comm_.rank()) return;
  append(parts_.plan.kick,
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
  run(parts_.plan.sums, global_);
  GlobalState part = global_;
  const auto kick = [&](double share) {
    part.dt = share * global_.dt;
    maxima_ = {};
    run(parts_.plan.kick, part);
    reduce(0, false);
    if (parts_.reduction[Reduction::bad] > 0) stop_at_fault();
    take_maxima();
    return parts_.longest_step();
  };
  global_.dt = kick(0);  // how large a step may be follows from the accelerations
  (void)kick(0.5);
  find_stale();
}

// Measured cost -> new cuts -> migrate -> sort by (Hilbert key of cell, id) -> halo plans -> lists of all
// pairs of sets.
void Simulation::rebuild() {
  united_.reset();
  std::vector<Distribution::Carried> carried(sets_.size());
  double least_skin = 0;
  for (SetPair* pair : parts_.pairs) {
    least_skin = std::max(least_skin, pair->least_skin(global_));
    if (!pair->carries()) continue;
    const auto timing = timers_.time(decomp::Region::lists);
    carried[pair->set()] = {pair->send(particles(pair->set()), std::exchange(arrived_, {})), true, {}};
  }
  {
    const auto timing = timers_.time(decomp::Region::migrate);
    try {
      distribution_.rebuild(
          sets_, timers_.take_cost(), [&](std::size_t set) { return pairs_of_rows(set); },
          *std::ranges::max_element(moved_), least_skin, carried);
    } catch (const GuardError& error) {
      throw GuardError(step_text(global_.step) + error.what());
    }
    if (census() != census_)
      throw GuardError("step " + std::to_string(global_.step) +
                       ": a particle was lost or duplicated in migration; reduce time.dt");
  }
  for (ParticleSet& set : sets_) set.exchange.forget();
  for (const SetPair* pair : parts_.pairs) refresh_halo(pair->constants(), pair->set());
  for (SetPair* pair : parts_.pairs) {
    const Distribution::Carried& with = carried[pair->set()];
    pair->rebuild(particles(pair->set()), list_setting(*pair), with.payload, with.order);
  }
  moved_.assign(sets_.size(), 0);
  ++counters_.rebuilds;
}

std::vector<decomp::Census> Simulation::census() const {
  std::vector<decomp::Census> out;
  for (const ParticleSet& set : sets_)
    out.push_back(decomp::census(comm_, set.particles.table(), set.particles.column(Field::id)));
  return out;
}

ListSetting Simulation::list_setting(const SetPair& pair) {
  return {comm_,
          distribution_.grid(),
          distribution_.own_cells(),
          distribution_.list_radius(),
          distribution_.skin(),
          sets_[pair.set()].ranges,
          global_,
          timers_,
          pair.other() == pair.set() ? nullptr : &sets_[pair.other()].particles};
}

std::vector<std::uint32_t> Simulation::pairs_of_rows(std::size_t set) const {
  std::vector<std::uint32_t> pairs(particles(set).owned(), 0);
  if (counters_.rebuilds == 0) return pairs;
  for (const SetPair* pair : parts_.pairs)
    if (pair->set() == set) pair->count(sets_[set].ranges, pairs);
  return pairs;
}

void Simulation::refresh_contacts() {
  if (stale_) {
    rebuild();
    stale_ = drifts_first();
  }
  refresh_halo(grains()->reads(), parts_.grains->set());
}

// What all ranks must know of this step. What it brings acts in the next one.
void Simulation::reduce(std::int64_t request, bool left) {
  parts_.reduction.clear();
  bool finite = std::isfinite(maxima_.speed) && std::isfinite(maxima_.acceleration) && !findings_.any();
  for (Model* m : parts_.models) finite = m->report(state_of(m->set(), global_), parts_.reduction) && finite;
  parts_.reduction[Reduction::speed] = finite ? maxima_.speed : 0;
  parts_.reduction[Reduction::acceleration] = finite ? maxima_.acceleration : 0;
  parts_.reduction[Reduction::bad] = finite ? 0 : 1;
  parts_.reduction[Reduction::left] = left ? 1 : 0;
  parts_.reduction[Reduction::request] = static_cast<double>(request);
  {
    const auto timing = timers_.time(decomp::Region::reduce);
    parts_.reduction.combine(comm_);
  }
}

void Simulation::take_maxima() {
  global_.max_speed = parts_.reduction[Reduction::speed];
  global_.max_acceleration = parts_.reduction[Reduction::acceleration];
  growth_ = 0;
  for (const Model* m : parts_.models) growth_ = std::max(growth_, m->growth(parts_.reduction));
}

std::int64_t Simulation::finish_step(std::int64_t request) {
  const Findings left = find_leavers();
  reduce(request, left.any());
  for (const Model* m : parts_.models) m->guard(comm_, state_of(m->set(), global_), parts_.reduction);
  if (parts_.reduction[Reduction::bad] > 0) stop_at_fault();
  if (parts_.reduction[Reduction::left] > 0) left.stop(comm_, step_text(global_.step));
  for (Model* m : parts_.models) {
    moved_[m->set()] += m->path(global_, parts_.reduction[Reduction::speed]);
    m->act(parts_.reduction, global_);
  }
  ++global_.step;
  global_.time += global_.dt;
  take_maxima();
  global_.dt = parts_.longest_step();
  for (const Model* m : parts_.models) m->guard_step(parts_.reduction, global_);
  find_stale();
  return static_cast<std::int64_t>(parts_.reduction[Reduction::request]);
}

double Simulation::look_back() const {
  double way = 0;
  for (const Model* m : parts_.models) way = std::max(way, m->longest_look_back(global_));
  return way;
}

// A particle that leaves the domain does so in this step, wherever a rebuild would next look at it. Few ranks
// have to look: how far particles were from the faces is known from the last rebuild, and so is a bound on
// their way since.
Findings Simulation::find_leavers() const {
  std::vector<double> moved = moved_;
  for (const Model* m : parts_.models) moved[m->set()] += m->path(global_, maxima_.speed);
  Findings found;
  if (*std::ranges::max_element(moved) < distribution_.to_face()) return found;
  for (const ParticleSet& set : sets_) found.add(distribution_.outside(set.particles));
  return found;
}

// Lists must hold every pair that a pass of the next step takes, wherever it takes its particles to be: after
// they have moved in it, or half a step before that. moved_ bounds every particle's path since the
// rebuild by the largest speed of each step: no positions to remember, and never late. A rebuild in that step
// finds lists that are wide enough for it, however small the scene's skin (rebuild()). Grains are looked at
// again when the bound runs out: one that flies through the sparse part of a scene must not cost rebuilds of
// the rest.
void Simulation::find_stale() {
  double next = 0, way = 0;
  for (std::size_t set = 0; set < sets_.size(); ++set) {
    const double of_set = longest_move(parts_.plan, set, global_);
    next = std::max(next, of_set);
    way = std::max(way, moved_[set] + of_set);
  }
  guard_motion(next);
  const int every = scene_.decomposition.rebuild_every;
  const bool wanted = growth_ > 1 || (every > 0 && global_.step % every == 0);
  stale_ = wanted || std::max(way, look_back()) > 0.5 * distribution_.skin();
  if (!stale_ || wanted) return;
  std::vector<double> looked(sets_.size(), 0);
  for (const Model* m : parts_.models) {
    const std::optional<double> by_model = m->longest_way(particles(m->set()), global_);
    if (!by_model) return;
    looked[m->set()] = std::max(looked[m->set()], *by_model);
  }
  const auto timing = timers_.time(decomp::Region::reduce);
  comm_.max(looked);
  moved_ = looked;
  // Another step of the fastest grain must fit, or this look was for nothing.
  stale_ =
      *std::ranges::max_element(moved_) + 2 * global_.max_speed * global_.dt > 0.5 * distribution_.skin();
}

}  // namespace sph
