// What [start] says of grains alone: their velocity and the tile.
#include <fmt/format.h>

#include <cstddef>

#include "scene/scene_resolve.hpp"

namespace sph {

void read_grain_velocity(const StartReader& table, Start& start) {
  const toml_tree::Node* value = table.find("velocity");
  if (value == nullptr) return;
  if (value->array() != nullptr) {
    start.velocity = InitialVelocity::uniform;
    start.uniform_velocity = *table.vector("velocity", dimension::speed);
  } else if (const auto* word = std::get_if<std::string>(&value->value); word == nullptr || *word != "rest") {
    table.fail("velocity",
               word == nullptr ? fmt::format("is {}", type_name(*value)) : fmt::format("is \"{}\"", *word),
               "grains start with \"rest\" or an array of speeds");
  }
}

Tile read_tile(const StartReader& start) {
  constexpr std::array axis_names{"x", "y", "z"};
  constexpr std::int64_t most_copies = 1'000'000;  // along one axis
  Tile tile;
  const auto table = start.table<keys::tile>();
  table.read(tile);
  const toml_tree::Node* value = table.find("repeat");
  const toml_tree::Array* counts = value->array();
  if (counts == nullptr || counts->size() != tile.repeat.size())
    table.fail("repeat", "must be an array of three whole numbers", "for example [4, 4, 1]");
  for (std::size_t a = 0; a < tile.repeat.size(); ++a) {
    const auto* n = std::get_if<std::int64_t>(&(*counts)[a].value);
    if (n == nullptr)
      table.fail("repeat", fmt::format("holds {}", type_name((*counts)[a])), "it must hold whole numbers");
    if (*n < 1 || *n > most_copies)
      table.fail("repeat", fmt::format("is {} in {}", *n, axis_names[a]),
                 fmt::format("it must be 1 to {}", most_copies));
    tile.repeat[a] = *n;
  }
  table.finish();
  return tile;
}

}  // namespace sph
