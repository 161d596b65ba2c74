// One kind of particles of a scene (its fluids and solids, or its grains) on one rank: the rows with the
// fields that its models read, and where copies of them are kept on other ranks.
#pragma once

#include <vector>

#include "decomp/halo.hpp"
#include "sph/neighbour_lists.hpp"
#include "sph/particles.hpp"
#include "sph/plan/halo_exchange.hpp"

namespace sph {

struct ParticleSet {
  Particles particles;
  std::vector<bool> stays;  ///< by group: its particles are no movers
  RowRanges ranges{};       ///< of the owned rows
  decomp::HaloPlan halo;
  HaloExchange exchange;

  /// Brings the halo copies of these fields up to date.
  void refresh(FieldSet fields, decomp::Timers& timers) {
    exchange.begin(halo, particles, fields, timers);
    exchange.end(halo, timers);
  }
  /// Halo copies of these fields are out of date.
  void changed(FieldSet fields) { exchange.changed(particles, fields); }
};

}  // namespace sph
