// The start from a settled packing of grains that is repeated side by side. Grain number n of the tile, in
// the order of its ids, is in copy c grain c N + n, N grains a tile, copies counted with x running fastest;
// all else is as in the tile, but for the shift. Every rank reads the whole tile, which is small beside the
// sum of its copies, and keeps what falls into its own box.
#pragma once

#include "sph/core/particles.hpp"
#include "sph/plan/distribution.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

/// Throws RowProblem where copies of so many grains are none, or more than any machine holds.
void check_tile_count(const Scene& scene, std::size_t grains);

/// Fills `particles` (empty) with this rank's share. Throws InputError "file: row: what" on all ranks.
void place_tiles(const Scene& scene, const PositionScale& scale, const Distribution& distribution,
                 Particles& particles);

}  // namespace sph
