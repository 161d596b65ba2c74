#include "sph/models/sph_pairs.hpp"

#include <algorithm>

#include "sph/pairs/fusions.hpp"

namespace sph {

SphPairs::SphPairs(std::size_t set, Physics& physics)
    : SetPair(set), physics_(&physics), lists_(lanes_of(physics.constants().scene->terms.precision)) {
  for (const Group& g : physics.constants().scene->groups) is_wall_.push_back(g.kind == GroupKind::wall);
}

// Stages take pairs where they were half a step ago, and shifting moves particles after the sums.
double SphPairs::least_skin(const GlobalState& global) const {
  const std::optional<Shifting>& shifting = physics_->models().shifting;
  const std::optional<RigidBodies>& rigid = physics_->models().rigid;
  return 2 * std::max({physics_->longest_look_back(global), shifting ? shifting->longest(global) : 0.0,
                       rigid ? rigid->longest_look_back(global) : 0.0});
}

void SphPairs::rebuild(const Particles& p, const ListSetting& s, const decomp::Payload&,
                       std::span<const std::uint32_t>) {
  GasReach* own = physics_->reach();
  if (own == nullptr) {
    lists_.build(p, s.grid, s.own_cells, s.radius, s.ranges, s.timers);
    if (p.has(Field::wall_share)) lists_.mark_walls(p, is_wall_);
    return;
  }
  const std::vector<double>& reaches = own->find(p);
  std::vector<double> quanta(reaches.size());
  for (std::size_t i = 0; i < quanta.size(); ++i)
    quanta[i] = (reaches[i] + s.skin) / physics_->constants().scale.quantum + 1;
  lists_.build(p, quanta, s.ranges, s.timers);
}

void SphPairs::count(const RowRanges& ranges, std::span<std::uint32_t> entries) const {
  const auto lanes = static_cast<std::size_t>(lists_.lanes());
  for (const RowRange& range : ranges)
    for (std::size_t first = range.first, b = range.first_block; first < range.last; first += lanes, ++b)
      share_block(entries, first, std::min<std::size_t>(first + lanes, range.last), lists_.block(b).size());
}

}  // namespace sph
