// The stages of a scene of fluids and solids: which models it has, and in which order they take part in a step.
#pragma once

#include <optional>
#include <vector>

#include "sph/models/builder.hpp"
#include "sph/models/gas.hpp"
#include "sph/models/gas_flow.hpp"
#include "sph/models/heat.hpp"
#include "sph/models/model.hpp"
#include "sph/models/openings.hpp"
#include "sph/models/resets.hpp"
#include "sph/models/rigid_bodies.hpp"
#include "sph/models/shifting.hpp"
#include "sph/models/water.hpp"

namespace sph {

/// Models of their own, where a scene has them.
struct SphModels {
  SphModels(std::size_t set, const Builder& builder);
  [[nodiscard]] std::vector<Model*> all();

  std::optional<Shifting> shifting;
  std::optional<Degassing> degassing;
  std::optional<Water> water;
  std::optional<Heat> heat;
  std::optional<Resets> resets;
  std::optional<RigidBodies> rigid;
  std::optional<Openings> openings;  ///< that begins before all others
};

void add_stages(Builder& builder, SphModels& models);

}  // namespace sph
