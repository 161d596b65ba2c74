// What `peperite keys` prints: every key of a scene as its entry in keys/ says.
#pragma once

#include <string>

namespace sph::keys {

/// A list to read.
[[nodiscard]] std::string reference_text();
/// A page with a table for each table of TOML (apps/keys.md).
[[nodiscard]] std::string reference_markdown();
/// TOML in which every key is commented out: copy, remove the #, change.
[[nodiscard]] std::string reference_toml();
/// The JSON schema by which editors complete and check scenes (apps/scene.schema.json).
[[nodiscard]] std::string reference_json_schema();

}  // namespace sph::keys
