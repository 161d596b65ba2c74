// Where a grain is, in the words of messages. Places are inside the domain: rows are wrapped when
// lists are made anew, and a message must not tell when that was.
#pragma once

#include <cstdint>
#include <string>

#include "sph/scene/positions.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

[[nodiscard]] std::string text_of_place(const Scene& scene, const PositionScale& scale,
                                        const std::int64_t* quanta);

}  // namespace sph
