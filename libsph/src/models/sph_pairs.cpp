#include "sph/models/sph_pairs.hpp"

#include <algorithm>

#include "sph/models/models.hpp"
#include "sph/pairs/fusions.hpp"

namespace sph {

namespace {

std::vector<bool> groups_of(const Scene& scene, GroupKind kind) {
  std::vector<bool> out;
  for (const Group& g : scene.groups) out.push_back(g.kind == kind);
  return out;
}

}  // namespace

SphPairs::SphPairs(std::size_t set, Physics& physics)
    : SetPair(set),
      physics_(&physics),
      lists_(lanes_of(physics.constants().scene->terms.precision),
             groups_of(*physics.constants().scene, GroupKind::fluid)),
      is_wall_(groups_of(*physics.constants().scene, GroupKind::wall)),
      ahead_(!physics.models().rigid &&
             std::ranges::none_of(physics.constants().scene->groups, [](const Group& g) {
               return std::ranges::any_of(g.wall.velocity, [](double v) { return v != 0; });
             })) {}

// Stages take pairs where they were half a step ago, and shifting moves particles after the sums.
double SphPairs::least_skin(const GlobalState& global) const {
  const std::optional<Shifting>& shifting = physics_->models().shifting;
  const std::optional<RigidBodies>& rigid = physics_->models().rigid;
  return 2 * std::max({physics_->longest_look_back(global), shifting ? shifting->longest(global) : 0.0,
                       rigid ? rigid->longest_look_back(global) : 0.0});
}

void SphPairs::rebuild(const Particles& p, const ListSetting& s, decomp::Payload&,
                       std::span<const std::uint32_t>) {
  GasReach* own = physics_->reach();
  if (own == nullptr) {
    lists_.all.build(p, s.grid, s.own_cells, s.radius, s.ranges, s.timers, PartnerOrder::by_id,
                     physics_->built().walls_look_at_movers() ? &is_wall_ : nullptr);
    lists_.fluid.forget();
    const auto timing = s.timers.time(decomp::Region::lists);
    ways_.begin(p, s.radius);
    skin_ = s.skin;
    if (p.has(Field::wall_share)) lists_.walls.build(p, lists_.all, s.ranges, is_wall_);
    if (!p.has(Field::displacement)) return;
    const SphConstants& k = physics_->constants();
    lists_.bonds.build(p, lists_.all, s.ranges, k.longest_bond(), k.groups.bodies.number);
    return;
  }
  const std::vector<double>& reaches = own->find(p);
  std::vector<double> quanta(reaches.size());
  for (std::size_t i = 0; i < quanta.size(); ++i)
    quanta[i] = (reaches[i] + s.skin) / physics_->constants().scale.quantum + 1;
  lists_.all.build(p, quanta, s.ranges, s.timers);
}

// Lists of a gas reach further where a particle's kernel is wider. Rigid bodies turn, and particles of walls are taken to
// have come from where their velocity says though they have not: of these it is not known where they will be. Where nothing
// drifts further than the skin, what is near half a step back, of two that drift past each other, is near after it.
std::optional<SetPair::Look> SphPairs::look_at_ways(const Particles& p, const GlobalState& global) const {
  if (physics_->reach() != nullptr) return std::nullopt;
  const double quantum = physics_->constants().scale.quantum, drift = longest_drift(global);
  const bool ahead = ahead_ && drift <= skin_;
  const WaysApart::Ways found = ways_.look(p, is_wall_, ahead ? global.dt / quantum : 0.0);
  const Ways seen{1.0001 * found.alone * quantum, 1.0001 * found.together * quantum};
  const Ways later{seen.alone + drift, seen.together + 2 * drift};
  return ahead ? Look{later, seen} : Look{seen, later};
}

// Of bodies passes look at bonds, and at all others only where fluid is near.
void SphPairs::count(const RowRanges& ranges, std::span<std::uint32_t> entries) const {
  const auto lanes = static_cast<std::size_t>(lists_.all.lanes());
  const bool bonds = lists_.bonds.blocks() > 0, wet = lists_.fluid.known();
  const auto looked_at = [&](std::size_t b) {
    if (!bonds) return lists_.all.block(b).size();
    return lists_.bonds.block(b).size() + (wet && lists_.fluid.is_beside(b) ? lists_.all.block(b).size() : 0);
  };
  for (const RowRange& range : ranges)
    for (std::size_t first = range.first, b = range.first_block; first < range.last; first += lanes, ++b)
      share_block(entries, first, std::min<std::size_t>(first + lanes, range.last), looked_at(b));
}

}  // namespace sph
