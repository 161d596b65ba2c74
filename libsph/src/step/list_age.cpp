#include "sph/step/list_age.hpp"

#include <algorithm>
#include <optional>

#include "step/guards.hpp"

namespace sph {

void ListAge::add_paths(double speed) {
  for (const Model* m : state_.models()) add(m->set(), m->path(state_.global(), speed));
}

double ListAge::longest() const { return *std::ranges::max_element(moved_); }

// A particle that leaves the domain does so in this step, wherever a rebuild would next look at it. Few ranks
// have to look: how far particles were from the faces is known from the last rebuild, and so is a bound on
// their way since.
Findings ListAge::leavers(double speed) const {
  ListAge with = *this;
  with.add_paths(speed);
  Findings found;
  if (with.longest() < state_.distribution().to_face()) return found;
  for (const ParticleSet& set : state_.sets()) found.add(state_.distribution().outside(set.particles));
  return found;
}

double ListAge::look_back() const {
  double way = 0;
  for (const Model* m : state_.models()) way = std::max(way, m->longest_look_back(state_.global()));
  return way;
}

void ListAge::guard() const {
  double next = look_back();
  for (std::size_t set = 0; set < moved_.size(); ++set)
    next = std::max(next, longest_move(state_.plan(), set, state_.global()));
  guard_motion(state_, next);
}

// Lists must hold every pair that a pass of the next step takes, wherever it takes its particles to be: after
// they have moved in it, or half a step before that. A rebuild in that step finds lists that are wide enough
// for it, however small the scene's skin (Simulation::rebuild). Grains are looked at again when the bound runs
// out: one that flies through the sparse part of a scene must not cost rebuilds of the rest.
bool ListAge::look(const Reduction& reduction, decomp::Timers& timers) {
  const GlobalState& global = state_.global();
  guard();
  double way = 0, growth = 0;
  for (std::size_t set = 0; set < moved_.size(); ++set)
    way = std::max(way, moved_[set] + longest_move(state_.plan(), set, global));
  for (const Model* m : state_.models()) growth = std::max(growth, m->growth(reduction));
  const int every = state_.scene().decomposition.rebuild_every;
  if (growth > 1 || (every > 0 && global.step % every == 0)) return true;
  const double half_skin = 0.5 * state_.distribution().skin();
  if (std::max(way, look_back()) <= half_skin) return false;
  std::vector<double> looked(moved_.size(), 0);
  for (const Model* m : state_.models()) {
    const std::optional<double> by_model = m->longest_way(state_.particles(m->set()), global);
    if (!by_model) return true;
    looked[m->set()] = std::max(looked[m->set()], *by_model);
  }
  const auto timing = timers.time(decomp::Region::reduce);
  state_.comm().max(looked);
  moved_ = looked;
  // Another step of the fastest grain must fit, or this look was for nothing.
  return longest() + 2 * global.max_speed * global.dt > half_skin;
}

}  // namespace sph
