// One kind of particles of a scene (its fluids and solids, or its grains) on one rank: the rows with the
// fields that its models read, and where copies of them are kept on other ranks.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "decomp/halo.hpp"
#include "decomp/migrate.hpp"
#include "sph/core/particles.hpp"
#include "sph/pairs/neighbour_lists.hpp"
#include "sph/plan/halo_exchange.hpp"

namespace sph {

/// The ranks that rows belong to, of a grid's cells.
using OwnersOf = std::function<std::vector<decomp::Rank>(const Particles&)>;

struct ParticleSet {
  Particles particles;
  std::vector<bool> stays;  ///< by group: its particles are no movers
  RowRanges ranges{};       ///< of the owned rows
  decomp::HaloPlan halo;
  HaloExchange exchange;
  decomp::Census census{};  ///< of its start
  OwnersOf owners{};        ///< of a set that stays where it is; empty: rows follow the cuts

  /// Brings the halo copies of these fields up to date.
  void refresh(FieldSet fields, decomp::Timers& timers, bool in_lines = false) {
    exchange.begin(halo, particles, fields, timers, in_lines);
    exchange.end(halo, timers);
  }
  /// Its owned particles, over all ranks: what `census` is unless some were lost. Collective.
  [[nodiscard]] decomp::Census count(const decomp::Comm& comm) const {
    return decomp::census(comm, particles.table(), particles.column(Field::id));
  }
  /// Halo copies of these fields are out of date.
  void changed(FieldSet fields) { exchange.changed(particles, fields); }
};

/// Those that follow the cuts: the others are last.
[[nodiscard]] inline std::span<ParticleSet> movable(std::span<ParticleSet> sets) {
  std::size_t n = 0;
  while (n < sets.size() && !sets[n].owners) ++n;
  return sets.first(n);
}

}  // namespace sph
