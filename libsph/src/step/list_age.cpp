#include "sph/step/list_age.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "sph/models/models.hpp"
#include "step/guards.hpp"

namespace sph {

void ListAge::add_paths(double speed) {
  for (const Model* m : state_.models()) add(m->set(), m->path(state_.global(), speed));
}

double ListAge::longest() const { return std::ranges::max_element(ways_, {}, &SetPair::Ways::alone)->alone; }

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
  for (std::size_t set = 0; set < ways_.size(); ++set)
    next = std::max(next, longest_move(state_.plan(), set, state_.global()));
  guard_motion(state_, next);
}

// Two particles that are not in each other's lists were further apart than these reach, and come within the range of
// interaction only after they have gone apart by the skin. Who knows both of them? If they were not twice as far apart as
// lists reach, the rank in whose box the middle between them was: its halo holds what is within that reach of the box. From
// further they cannot come before one of them has gone half of what lies between. A look bounds the ways of all that are
// then no further apart than lists reach; others have yet to go towards each other by the skin. Where it looks ahead to
// the end of the next drift, `together` may be less than nothing until then.
bool ListAge::serve(std::span<const SetPair::Ways> ways) const {
  const Distribution& d = state_.distribution();
  const Scene& scene = state_.scene();
  const double range = scene.list_range(), reach = range + d.skin();
  // In single precision a difference of places is right up to seven times this (row_position_shift), however far listed
  // pairs fly apart.
  const double single = scene.total_lagrangian() ? scene.support() : range;
  const double furthest = std::min(0.5 * range + d.skin(), 0.5 * (6 * single - reach));
  return std::ranges::all_of(
      ways, [&](const SetPair::Ways& w) { return w.together <= d.skin() && w.alone <= furthest; });
}

std::vector<SetPair::Ways> ListAge::next() const {
  std::vector<SetPair::Ways> out = ways_;
  for (std::size_t set = 0; set < out.size(); ++set) {
    const double way = std::max(longest_move(state_.plan(), set, state_.global()), 2 * look_back());
    out[set] = {out[set].alone + way, out[set].together + 2 * way};
  }
  return out;
}

std::optional<std::vector<SetPair::Ways>> ListAge::measure(std::span<ParticleSet> sets,
                                                           decomp::Timers& timers) {
  const auto of_two_sets = [](const SetPair* pair) { return pair->set() != pair->other(); };
  if (pairs_.empty() || std::ranges::any_of(pairs_, of_two_sets)) return std::nullopt;
  std::vector<double> all(4 * ways_.size(), 0);
  for (const SetPair* pair : pairs_) {
    ParticleSet& set = sets[pair->set()];
    const SetPair::LookedAt looked_at = pair->looked_at();
    set.refresh(looked_at.fields, timers, looked_at.in_lines);
    const auto timing = timers.time(decomp::Region::lists);
    const std::optional<SetPair::Look> own = pair->look_at_ways(set.particles, state_.global());
    if (!own) return std::nullopt;
    const std::array seen{own->now.alone, own->now.together, own->next.alone, own->next.together};
    for (std::size_t k = 0; k < seen.size(); ++k)
      all[4 * pair->set() + k] = std::max(all[4 * pair->set() + k], seen[k]);
  }
  {
    const auto timing = timers.time(decomp::Region::reduce);
    state_.comm().max(all);
  }
  // What the next step adds to the ways of its drift is there already in those that were seen ahead.
  const double drift = longest_drift(state_.global());
  std::vector<SetPair::Ways> ahead(ways_.size());
  for (std::size_t set = 0; set < ways_.size(); ++set) {
    const double* of = all.data() + 4 * set;
    ways_[set] = {std::min(of[0], of[2] - drift), std::min(of[1], of[3] - 2 * drift)};
    ahead[set] = {of[2], of[3]};
  }
  return ahead;
}

// Lists must hold every pair that a pass of the next step takes, wherever it takes its particles to be: after
// they have moved in it, or half a step before that. A rebuild in that step finds lists that are wide enough
// for it, however small the scene's skin (Simulation::rebuild). One particle that flies through the sparse part of
// a scene must not cost rebuilds of the rest.
bool ListAge::look(const Reduction& reduction, std::span<ParticleSet> sets, decomp::Timers& timers) {
  const GlobalState& global = state_.global();
  guard();
  double growth = 0;
  for (const Model* m : state_.models()) growth = std::max(growth, m->growth(reduction));
  const int every = state_.scene().decomposition.rebuild_every;
  if (growth > 1 || (every > 0 && global.step % every == 0)) return true;
  if (2 * look_back() > state_.distribution().skin()) return true;
  if (serve(next())) return false;
  const std::optional<std::vector<SetPair::Ways>> ahead = measure(sets, timers);
  return !ahead || !serve(*ahead) || !serve(next());
}

}  // namespace sph
