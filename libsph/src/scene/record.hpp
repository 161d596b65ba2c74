// The scene that a file of a run holds, for what is to be known of the file: nothing that it names is read.
#pragma once

#include <string>

#include "sph/scene/scene.hpp"

namespace sph {

/// Throws InputError. Whether it has a surface is not known where regions are meshes.
[[nodiscard]] Scene parse_record(const std::string& text, const std::string& name);

}  // namespace sph
