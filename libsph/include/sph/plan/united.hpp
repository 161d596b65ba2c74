// The particles of all sets of a scene as one table, as files have them: sorted by nothing, set after set.
// Fields that a set does not have are 0 there.
#pragma once

#include <span>
#include <vector>

#include "decomp/migrate.hpp"
#include "sph/plan/particle_set.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

/// The fields of any set.
[[nodiscard]] FieldSet fields_of(std::span<const ParticleSet> sets);
/// The owned rows of all sets.
[[nodiscard]] Particles unite(std::span<const ParticleSet> sets);
/// Of a payload that travels with the rows of one set: the same with an entry for each row of all.
[[nodiscard]] decomp::Payload unite(decomp::Payload of_set, std::span<const ParticleSet> sets,
                                    std::size_t set);
/// Puts each row of `all` into its set, which is empty: grains into the one that has radii. What `carried`
/// has for rows of other sets than `carrier` is nothing.
void divide(const Particles& all, const Scene& scene, std::span<ParticleSet> sets, decomp::Payload& carried,
            std::size_t carrier);

}  // namespace sph
