#include "sph/pairs/fluid_blocks.hpp"

#include <algorithm>

namespace sph {

void FluidBlocks::look_at_interior(const Particles& particles, const NeighbourLists& lists,
                                   const RowRanges& ranges) {
  constexpr std::uint8_t unknown = 2;
  if (rows_.size() != particles.rows()) rows_.assign(particles.rows(), unknown);
  blocks_.resize(lists.blocks());
  if (!look_at_rows(particles, 0, particles.owned())) return;
  boundary_is_old_ = true;
  mark(lists, range_of(ranges, RowClass::interior_movers));
  mark(lists, range_of(ranges, RowClass::interior_walls));
}

void FluidBlocks::look_at_boundary(const Particles& particles, const NeighbourLists& lists,
                                   const RowRanges& ranges) {
  if (!look_at_rows(particles, particles.owned(), particles.rows()) && !boundary_is_old_) return;
  boundary_is_old_ = false;
  mark(lists, range_of(ranges, RowClass::boundary_movers));
  mark(lists, range_of(ranges, RowClass::boundary_walls));
}

bool FluidBlocks::look_at_rows(const Particles& particles, std::size_t first, std::size_t last) {
  const auto* group = particles.data<Field::group>();
  bool changed = false;
  for (std::size_t i = first; i < last; ++i) {
    const std::uint8_t now = is_fluid_[group[i]] ? 1 : 0;
    changed = changed || now != rows_[i];
    rows_[i] = now;
  }
  return changed;
}

void FluidBlocks::mark(const NeighbourLists& lists, const RowRange& range) {
  const auto lanes = static_cast<std::size_t>(lists.lanes());
  const auto is_fluid = [&](std::size_t i) { return rows_[i] == 1; };
  for (std::size_t first = range.first, b = range.first_block; first < range.last; first += lanes, ++b) {
    const auto own = std::span(rows_).subspan(first, std::min(lanes, range.last - first));
    blocks_[b] = std::ranges::find(own, 1) != own.end()          ? Fluid::row
                 : std::ranges::any_of(lists.block(b), is_fluid) ? Fluid::partner
                                                                 : Fluid::none;
  }
}

}  // namespace sph
