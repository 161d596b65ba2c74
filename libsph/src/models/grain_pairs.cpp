#include "sph/models/grain_pairs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "decomp/memory.hpp"
#include "models/grain_texts.hpp"
#include "sph/laws/contact/law.hpp"
#include "sph/models/grain_limits.hpp"

namespace sph {

GrainPairs::GrainPairs(std::size_t set, const Scene& scene, const PositionScale& scale,
                       const GrainWalls& walls)
    : SetPair(set),
      scene_(&scene),
      scale_(scale),
      walls_(&walls),
      lists_(contact_fusion(scene).parities),
      spins_(contact_fusion(scene).spins) {
  for (const Group& g : scene.groups) fixed_.push_back(g.grain.fixed);
}

ContactSums& GrainPairs::sums(const Particles& particles) {
  if (!sums_.empty()) return sums_;
  const std::size_t stride = spins_ ? 8 : 4;
  const auto *radius = particles.data<Field::radius>(), *mass = particles.data<Field::mass>();
  sums_.assign(particles.rows() * stride, 0);
  for (std::size_t i = 0; i < particles.owned(); ++i) {
    const double inverse_mass = 1 / mass[i];
    sums_[i * stride + 3] = std::bit_cast<std::uint64_t>(inverse_mass);
    if (spins_)
      sums_[i * stride + 7] = std::bit_cast<std::uint64_t>(2.5 * inverse_mass / (radius[i] * radius[i]));
  }
  return sums_;
}

decomp::Payload GrainPairs::pack(const Particles& particles) const {
  decomp::release(sums_);
  return lists_.pack(particles);
}

decomp::Payload GrainPairs::send(const Particles& particles, decomp::Payload arrived) {
  if (held_)
    arrived = *std::exchange(held_, std::nullopt);
  else if (arrived.rows() == 0)
    arrived = pack(particles);
  sent_ = ContactLists::census(particles, arrived, lists_.history());
  lists_.forget_histories();
  return arrived;
}

void GrainPairs::turn_over(const Particles& particles, std::span<const std::uint64_t> gone,
                           std::span<const std::uint32_t> order, std::size_t come) {
  decomp::Payload contacts = pack(particles);
  counters_.ended += forget_contacts(contacts, particles.data<Field::id>(), gone, lists_.history());
  contacts.reorder(order);
  contacts.offset.insert(contacts.offset.end(), come, contacts.offset.back());
  held_ = std::move(contacts);
}

// Count and keys of the entries found are those that set out.
void GrainPairs::rebuild(const Particles& particles, const ListSetting& s, decomp::Payload& carried,
                         std::span<const std::uint32_t> order) {
  ContactCensus found;
  Findings lost;
  {
    const auto timing = s.timers.time(decomp::Region::lists);
    found = find_pairs(particles, s, carried, order);
    find_lost(particles, s.global, s.skin, lost);
  }
  const auto timing = s.timers.time(decomp::Region::reduce);  // who waits does not work: no cost of this rank
  std::array<std::uint64_t, 6> all{sent_.count, sent_.keys,      found.count,
                                   found.keys,  found.one_sided, lost.any() ? 1U : 0U};
  s.comm.sum(std::span<std::uint64_t>(all));
  if (all[5] != 0) lost.stop(s.comm, step_text(s.global.step));
  if (all[0] != all[2] || all[1] != all[3] || all[4] != 0)
    throw GuardError(fmt::format(
        "step {}: of {} entries of contacts {} were found again after the lists were rebuilt; reduce time.dt",
        s.global.step, all[0], all[2]));
}

ContactCensus GrainPairs::find_pairs(const Particles& particles, const ListSetting& s,
                                     decomp::Payload& carried, std::span<const std::uint32_t> order) {
  // A wall that a later stage brings near must be listed in time: walls are looked for where they are now.
  const WallsNow walls = walls_->now(s.global);
  lists_.build(particles, s.grid, s.own_cells, s.radius, s.skin, scale_.quantum, s.ranges, fixed_, walls);
  const ContactCensus found = lists_.unpack(particles, carried, order, scale_.quantum, walls);
  counters_.carried += lists_.carried();
  carried = decomp::Payload();
  decomp::release(sums_);  // of the rows that were
  ways_.begin(particles, walls, s.radius, s.skin, scale_.quantum);
  return found;
}

void GrainPairs::count(const RowRanges&, std::span<std::uint32_t> entries) const {
  const auto groups_of = [](const ContactBlock& b) {
    return b.pairs.last - b.pairs.first + b.candidates.last - b.candidates.first;
  };
  for (const auto blocks : {lists_.interior(), lists_.boundary()})
    for (const ContactBlock& b : blocks)
      share_block(entries, b.first, b.last, groups_of(b) * ContactGroups::lanes);
}

FieldSet GrainPairs::swept() const {
  FieldSet fields{Field::position, Field::velocity};
  if (spins_) fields |= FieldSet{Field::spin};
  return fields;
}

// Grains in melts are looked for on the flow's grid, which relies on it that none has gone further than half the skin. Another
// step of the fastest grain must fit after the next, or this look was for nothing.
std::optional<SetPair::Look> GrainPairs::look_at_ways(const Particles& particles,
                                                      const GlobalState& global) const {
  Ways now = ways_.look(particles, walls_->now(global));
  if (scene_->is_suspension()) now.together = std::max(now.together, 2 * now.alone);
  const double step = global.max_speed * global.dt;
  return Look{now, {now.alone + 2 * step, now.together + 4 * step}};
}

SetPair::LookedAt GrainPairs::looked_at() const {
  if (scene_->is_suspension()) return {{Field::position}};
  return {swept(), true};
}

void GrainPairs::forget_parted(const Particles& particles) {
  counters_.ended += lists_.forget_parted(particles.data<Field::id>());
}

void GrainPairs::add(const ContactSweep& swept) {
  counters_.created += swept.created;
  counters_.ended += swept.ended;
}

void GrainPairs::find_lost(const Particles& p, const GlobalState& global, double skin, Findings& lost) const {
  const double* v = p.data<Field::velocity>();
  for (const ContactLists::Parted& parted : lists_.parted()) {
    const bool with_wall = (parted.key & wall_key) != 0;
    if (parted.listed || (with_wall && !walls_->present(parted.key, global))) continue;
    const std::size_t i = parted.row;
    const double own =
        std::sqrt(v[i * 3] * v[i * 3] + v[i * 3 + 1] * v[i * 3 + 1] + v[i * 3 + 2] * v[i * 3 + 2]);
    // A wall's speed may have changed since; it is never above the limit.
    const double way = own * global.dt +
                       (with_wall ? longest_grain_move(*scene_) : global.max_speed * global.dt) +
                       4 * scale_.quantum;
    if (1.0001 * way > skin) continue;
    const std::uint64_t id = p.data<Field::id>()[i];
    lost.add(id, [&] {
      return fmt::format(
          "the contact of grain {} {} with {} was lost when the lists were rebuilt; reduce "
          "time.dt or raise decomposition.skin",
          id, text_of_place(*scene_, scale_, p.data<Field::position>() + i * 3),
          text_of_partner(*scene_, parted.key));
    });
  }
}

}  // namespace sph
