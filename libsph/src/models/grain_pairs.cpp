// Contacts when rows move: histories travel with the grains and go back to their pairs. None may be lost or
// doubled on its way: count and keys are those of the entries that set out.
#include <array>
#include <string>

#include "sph/models/grains.hpp"

namespace sph {

decomp::Payload Grains::send(const Particles& particles, decomp::Payload arrived) {
  sums_ = {};  // while contacts travel, memory is at its peak
  if (arrived.rows() == 0) arrived = lists_.pack(particles);
  sent_ = ContactLists::census(particles, arrived, lists_.history());
  return arrived;
}

void Grains::rebuild(const Particles& particles, const ListSetting& s, const decomp::Payload& carried,
                     std::span<const std::uint32_t> order) {
  const auto timing = s.timers.time(decomp::Region::lists);
  const ContactCensus found = find_pairs(particles, s, carried, order);
  Findings lost;
  find_lost(particles, s.global, s.skin, lost);
  std::array<std::uint64_t, 6> all{sent_.count, sent_.keys,      found.count,
                                   found.keys,  found.one_sided, lost.any() ? 1U : 0U};
  s.comm.sum(std::span<std::uint64_t>(all));
  if (all[5] != 0) lost.stop(s.comm, step_text(s.global.step));
  if (all[0] != all[2] || all[1] != all[3] || all[4] != 0)
    throw GuardError("step " + std::to_string(s.global.step) + ": of " + std::to_string(all[0]) +
                     " entries of contacts " + std::to_string(all[2]) +
                     " were found again after the lists were rebuilt; reduce time.dt");
}

ContactCensus Grains::find_pairs(const Particles& particles, const ListSetting& s,
                                 const decomp::Payload& carried, std::span<const std::uint32_t> order) {
  // A wall that a later stage brings near must be listed in time: walls are looked for where they are now.
  const std::vector<PlaneNow> planes = this->planes(s.global);
  lists_.build(particles, s.grid, s.own_cells, s.radius, s.skin, scale_.quantum, s.ranges, fixed_, planes);
  const ContactCensus found = lists_.unpack(particles, carried, order, scale_.quantum, planes);
  counters_.carried += lists_.carried();
  sums_.assign(particles.rows() * (fusion_.spins ? 8 : 4), 0);
  const std::int64_t* x = particles.data<Field::position>();
  reference_.assign(x, x + particles.owned() * 3);
  wall_reference_.clear();
  for (const WallState& w : s.global.walls) wall_reference_.push_back(w.offset);
  return found;
}

void Grains::count(const RowRanges&, std::span<std::uint32_t> entries) const {
  for (const auto blocks : {lists_.interior(), lists_.boundary()})
    for (const ContactBlock& b : blocks)
      share_block(entries, b.first, b.last, (b.pairs_end - b.pairs) * ContactGroups::lanes);
}

}  // namespace sph
