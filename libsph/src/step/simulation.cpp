#include "sph/step/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "step/guards.hpp"

namespace sph {
namespace {

/// What the stages look at for each row of a set, where there are lists.
std::vector<std::uint32_t> pairs_of_rows(const Parts& parts, const ParticleSet& of, std::size_t set,
                                         bool listed) {
  std::vector<std::uint32_t> pairs(of.particles.owned(), 0);
  for (const SetPair* pair : parts.pairs)
    if (listed && pair->set() == set) pair->count(of.ranges, pairs);
  return pairs;
}

void take_maxima(const Reduction& reduction, GlobalState& global) {
  global.max_speed = reduction[Reduction::speed];
  global.max_acceleration = reduction[Reduction::acceleration];
}

}  // namespace

std::int64_t Simulation::step(std::int64_t request, const Accelerate& accelerate) {
  if (accelerate) refuse_stillness(scene_);
  if (global_.step == 0 && parts_.plan.half_kick) kick_half_a_step(accelerate);
  united_.reset();
  runner_.forget_maxima();
  runner_.run(parts_.plan.drift, global_);
  if (stale_) rebuild();
  runner_.ask(accelerate, global_.time + (may_drift(parts_.plan) ? global_.dt : 0));
  united_.reset();
  runner_.run(parts_.plan.sums, global_);
  runner_.run(parts_.plan.kick, global_);
  return finish_step(request);
}

// Velocities of a step are those of half a step later.
void Simulation::kick_half_a_step(const Accelerate& accelerate) {
  runner_.ask(accelerate, global_.time);
  runner_.run(parts_.plan.sums, global_);
  GlobalState part = global_;
  const auto kick = [&](double share) {
    part.dt = share * global_.dt;
    runner_.forget_maxima();
    runner_.run(parts_.plan.kick, part);
    reduce(0, false);
    if (parts_.reduction[Reduction::bad] > 0) stop_at_fault(*this, runner_.findings());
    take_maxima(parts_.reduction, global_);
    return parts_.longest_step();
  };
  global_.dt = kick(0);  // how large a step may be follows from the accelerations
  (void)kick(0.5);
  stale_ = age_.look(parts_.reduction, sets_, timers_);
}

// Measured cost -> new cuts -> migrate -> sort by (Hilbert key of cell, id) -> halo plans -> lists of all
// pairs of sets.
void Simulation::rebuild() {
  united_.reset();
  runner_.forget_rows();
  const std::span<ParticleSet> sets = movable(sets_);
  std::vector<Distribution::Carried> carried(sets.size());
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
          sets, timers_.take_cost(),
          [&](std::size_t set) {
            return pairs_of_rows(parts_, sets_[set], set, rebuilds_ > 0 && !rows_changed_);
          },
          age_.longest(), least_skin, carried);
    } catch (const GuardError& error) {
      throw GuardError(step_text(global_.step) + error.what());
    }
    for (const ParticleSet& set : sets)
      if (set.count(comm_) != set.census)
        throw GuardError(step_text(global_.step) +
                         "a particle was lost or duplicated in migration; reduce time.dt");
  }
  for (ParticleSet& set : sets) set.exchange.forget();
  for (const SetPair* pair : parts_.pairs) refresh_halo(pair->constants(), pair->set());
  for (SetPair* pair : parts_.pairs) {
    Distribution::Carried& with = carried[pair->set()];
    pair->rebuild(particles(pair->set()), list_setting(*pair), with.payload, with.order);
  }
  age_.renew();
  ++rebuilds_;
  rows_changed_ = false;
}

ListSetting Simulation::list_setting(const SetPair& pair) {
  return {comm_,
          distribution_.grid(),
          distribution_.partition(),
          distribution_.own_cells(),
          distribution_.list_radius(),
          distribution_.skin(),
          sets_[pair.set()].ranges,
          global_,
          timers_,
          pair.other() == pair.set() ? nullptr : &sets_[pair.other()].particles};
}

void Simulation::refresh_contacts() {
  if (stale_) {
    rebuild();
    stale_ = may_drift(parts_.plan);
  }
  refresh_halo(grains()->pairs().swept(), parts_.grains->set());
}

// What all ranks must know of this step. What it brings acts in the next one.
void Simulation::reduce(std::int64_t request, bool left) {
  parts_.reduction.clear();
  const StepMaxima& maxima = runner_.maxima();
  bool finite =
      std::isfinite(maxima.speed) && std::isfinite(maxima.acceleration) && !runner_.findings().any();
  for (Model* m : parts_.models)
    finite = m->report(runner_.state_of(m->set(), global_), parts_.reduction) && finite;
  parts_.reduction[Reduction::speed] = finite ? maxima.speed : 0;
  parts_.reduction[Reduction::acceleration] = finite ? maxima.acceleration : 0;
  parts_.reduction[Reduction::bad] = finite ? 0 : 1;
  parts_.reduction[Reduction::left] = left ? 1 : 0;
  parts_.reduction[Reduction::request] = static_cast<double>(request);
  {
    const auto timing = timers_.time(decomp::Region::reduce);
    parts_.reduction.combine(comm_);
  }
}

std::int64_t Simulation::finish_step(std::int64_t request) {
  const Findings left = age_.leavers(runner_.maxima().speed);
  reduce(request, left.any());
  for (const Model* m : parts_.models) m->guard(comm_, runner_.state_of(m->set(), global_), parts_.reduction);
  if (parts_.reduction[Reduction::bad] > 0) stop_at_fault(*this, runner_.findings());
  if (parts_.reduction[Reduction::left] > 0) left.stop(comm_, step_text(global_.step));
  for (Model* m : parts_.models) m->act(parts_.reduction, global_);
  age_.add_paths(parts_.reduction[Reduction::speed]);
  for (const Model* m : parts_.models) sets_[m->set()].changed(m->follow(sets_[m->set()].particles, global_));
  ++global_.step;
  global_.time += global_.dt;
  take_maxima(parts_.reduction, global_);
  global_.dt = parts_.longest_step();
  for (const Model* m : parts_.models) m->guard_step(parts_.reduction, global_);
  // Where particles come or go lists are made at once: no file or monitor sees others.
  for (Model* m : parts_.models)
    if (const auto far = m->turn_over(distribution_, parts_.reduction, sets_[m->set()], global_)) {
      age_.add(m->set(), *far);
      rows_changed_ = true;
    }
  if (rows_changed_) {
    age_.guard();  // or lists could reach further than there are cells to look into
    rebuild();
  }
  stale_ = age_.look(parts_.reduction, sets_, timers_);
  return static_cast<std::int64_t>(parts_.reduction[Reduction::request]);
}

}  // namespace sph
