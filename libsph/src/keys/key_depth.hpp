// Keys like a.b.c make a table in a table for each dot, and the TOML library takes such a tree apart by
// recursion: 10^5 dots end the program. (Arrays and inline tables in each other it counts itself, up to 256.)
// So dots are counted before it sees them; tables of a scene are no more than three deep.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace sph::toml_tree {

inline constexpr std::size_t most_key_parts = 8;
inline constexpr std::string_view deep_key_advice = "keys of a scene are like start.tile.repeat";

struct TextPlace {
  std::size_t line = 1, column = 1;
};

/// Where the first key of more than most_key_parts parts has its last one, outside texts and comments.
[[nodiscard]] std::optional<TextPlace> deep_key(std::string_view toml);

}  // namespace sph::toml_tree
