// peperite check --plan: what a step of a scene does, stage by stage.
#pragma once

#include <string>

#include "sph/models/parts.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

[[nodiscard]] std::string plan_text(const Scene& scene, const Parts& parts);

}  // namespace sph
