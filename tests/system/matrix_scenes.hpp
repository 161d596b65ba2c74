// The scenes of the equivalence matrix: those of the apps and of tests/scenes, made soft and given a push, so
// that within some hundred steps particles cross cells and cuts, lists go stale and gas comes out.
#pragma once

#include <string>

#include "factors.hpp"
#include "sph/scene/scene.hpp"
#include "sph/step/simulation.hpp"

namespace equivalence {

/// The scene of a row. What depends on the number of ranks (cuts) or on files is left to the caller.
[[nodiscard]] sph::Scene scene_of(const Row& row);

/// What a run of the scene has to show, or agreement proves little: none of these may stay as at the start.
struct Liveliness {
  std::int64_t rebuilds = 0;
  std::int64_t spray = 0;       ///< particles in groups that others fragment into
  double void_fraction = 0;     ///< the largest
  std::int64_t yielded = 0;     ///< particles of solids with strength that have flown
  std::int64_t unstrained = 0;  ///< particles of total-Lagrangian bodies that nothing has touched yet
  std::int64_t touched = 0;     ///< particles of rigid bodies that another one or a wall pushes
  std::int64_t contacts = 0, contacts_begun = 0, contacts_ended = 0;
  std::int64_t histories_kept = 0;  ///< over rebuilds, once each
  bool walls_moved = false;         ///< up or down
  std::int64_t dragged = 0;         ///< grains that a fluid pushes
  std::int64_t come = 0, gone = 0;  ///< through openings
};
[[nodiscard]] Liveliness liveliness(const sph::Simulation& simulation);  ///< of this rank's particles

/// Throws std::runtime_error when a 1-rank run of `scene` was too quiet.
void check_lively(const sph::Scene& scene, const Liveliness& start, const Liveliness& end);
/// Has this rank movers with partners in the halo?
[[nodiscard]] bool has_boundary(const sph::Simulation& simulation);
/// Throws std::runtime_error when the cut axes have few cells, or when after some 100 steps most ranks have
/// no particles or none ever had a boundary; `shared`: steps in which this rank had one. Collective.
void check_shared_out(const sph::Simulation& simulation, std::int64_t shared);

}  // namespace equivalence
