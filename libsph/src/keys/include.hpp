// Scenes that are made of several files: the key `include`.
#pragma once

#include <string>

#include "keys/toml_tree.hpp"

namespace sph::toml_tree {

/// The document in `path`. Throws InputError where there is none.
[[nodiscard]] Node read(const std::string& path);

/// `document`, of `file`, on top of what it includes. No key `include` is left in it.
[[nodiscard]] Node with_includes(Node document, const std::string& file);

}  // namespace sph::toml_tree
