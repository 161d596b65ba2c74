// The JSON schema of scenes (draft 2020-12). It knows types, words and bounds of each key; which keys go together
// only the program checks, and which are missing, since a file may add to others (include).
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "keys/all_keys.hpp"
#include "keys/law_keys.hpp"
#include "keys/reference.hpp"

namespace sph::keys {
namespace {

using Json = nlohmann::ordered_json;

/// Numbers may be texts with a unit, to which bounds do not apply.
Json quantity() { return {{"type", {"number", "string"}}}; }

Json schema_of(const Number& n) {
  Json out = quantity();
  const Range& r = n.range;
  if (std::isfinite(r.least)) out[r.above_least ? "exclusiveMinimum" : "minimum"] = r.least;
  if (std::isfinite(r.most)) out[r.below_most ? "exclusiveMaximum" : "maximum"] = r.most;
  return out;
}
Json array_of(const Json& item, int least = 2, int most = 3) {
  return {{"type", "array"}, {"minItems", least}, {"maxItems", most}, {"items", item}};
}
Json schema_of(const Vector&) { return array_of(quantity()); }
Json schema_of(const Whole& w) {
  Json out{{"type", "integer"}, {"minimum", w.least}};
  if (w.most < std::numeric_limits<std::int64_t>::max()) out["maximum"] = w.most;
  return out;
}
Json schema_of(const Flag&) { return {{"type", "boolean"}}; }
Json schema_of(const Flags&) { return array_of({{"type", "boolean"}}); }
Json schema_of(const Text&) { return {{"type", "string"}}; }
Json schema_of(const File&) { return {{"type", "string"}}; }
Json schema_of(const NameOf&) { return {{"type", "string"}}; }
Json schema_of(const TwoGroups&) { return array_of({{"type", "string"}}, 2, 2); }
Json schema_of(const Copies&) { return array_of({{"type", "integer"}, {"minimum", 1}}, 2, 3); }
Json schema_of(const Words& w) {
  Json words = Json::array();
  for (const Word& word : w.all()) words.push_back(word.text);
  return {{"enum", words}};
}
Json schema_of(const Special& s) { return Json::parse(s.schema); }

Json object(const KeyTable& table);
Json schema_of(const Inner& inner) {
  return inner.table->array ? Json{{"type", "array"}, {"items", object(*inner.table)}} : object(*inner.table);
}

std::string description(const Key& key) {
  const auto* number = std::get_if<Number>(&key.kind);
  const auto* vector = std::get_if<Vector>(&key.kind);
  const Dimension dim = number != nullptr ? number->dim : vector != nullptr ? vector->dim : dimension::none;
  const std::string place = place_of(key);
  return fmt::format("{}{}{}{}{}Default: {}.", key.sentence, key.sentence.empty() ? "" : " ",
                     dim == dimension::none ? "" : fmt::format("In {}. ", si_unit(dim)),
                     place.empty() ? "" : "Of ", place.empty() ? "" : place + ". ", default_of(key));
}

Json object(const KeyTable& table) {
  Json properties = Json::object();
  for (const Key& key : keys_of(table)) {
    Json schema = std::visit([](const auto& kind) { return schema_of(kind); }, key.kind);
    if (!schema.contains("description")) schema["description"] = description(key);
    if (const std::string standard = standard_of(key);
        !standard.empty() && key.otherwise.empty() && !key.required)
      if (!standard.starts_with('[')) schema["default"] = Json::parse(standard);
    properties[std::string(key.name)] = std::move(schema);
  }
  return {{"type", "object"},
          {"description", table.sentence},
          {"additionalProperties", false},
          {"properties", std::move(properties)}};
}

}  // namespace

std::string reference_json_schema() {
  Json out{{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "A scene of Peperite"}};
  out.update(object(top));
  return out.dump(1) + '\n';
}

}  // namespace sph::keys
