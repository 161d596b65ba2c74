// peperite check --plan: what a step of a scene does, stage by stage.
#pragma once

#include <string>

#include "sph/plan/plan.hpp"
#include "sph/scene.hpp"

namespace sph {

/// `fields`: those the scene has.
[[nodiscard]] std::string plan_text(const Scene& scene, const Plan& plan, FieldSet fields);

}  // namespace sph
