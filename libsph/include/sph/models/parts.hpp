// What a scene is made of: its sets of particles, the models that say what happens to them, the pairs of
// sets, and the plan of a step that follows. Which models a scene has is said here and in physics.cpp.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "sph/models/drag.hpp"
#include "sph/models/grain_openings.hpp"
#include "sph/models/grains.hpp"
#include "sph/models/melt.hpp"
#include "sph/models/physics.hpp"
#include "sph/models/sph_pairs.hpp"
#include "sph/models/suspension.hpp"
#include "sph/plan/particle_set.hpp"
#include "sph/plan/plan.hpp"
#include "sph/plan/reduction.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

struct Parts {
  Parts(const decomp::Comm& comm, const Scene& scene, const PositionScale& scale);
  Parts(const Parts&) = delete;  // the plan holds on to the models
  Parts& operator=(const Parts&) = delete;

  struct Set {
    FieldSet fields;
    std::vector<bool> stays;  ///< by group: its particles are no movers
    OwnersOf owners{};        ///< of a set of cells, which no cut moves
  };
  std::vector<Set> sets;           ///< those of cells last
  std::optional<Physics> physics;  ///< of fluids and solids, where there are any
  std::optional<SphPairs> sph_pairs;
  std::optional<Grains> grains;
  std::optional<GrainOpenings> grain_openings;
  std::optional<Drag> drag;  ///< of grains in a fluid
  std::unique_ptr<Melt> melt;
  std::optional<Suspension> suspension;  ///< of grains in melts
  std::vector<Model*> models;
  std::vector<SetPair*> pairs;
  Plan plan;
  Reduction reduction;  ///< with the places of all models

  /// How long the next step may be after one that found what `reduction` says; at first, if nothing moves [s].
  [[nodiscard]] double longest_step() const;
};

}  // namespace sph
