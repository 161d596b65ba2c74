#include "keys/toml_tree.hpp"

#include <fmt/format.h>

// The TOML library's release build takes its assertions for granted, and a header like "[=" breaks one of
// them; turned off instead, they leave the error to the branch that reports it.
#undef NDEBUG
#define TOML_ASSERT(expression) static_assert(true)
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <utility>

#include "core/nearest.hpp"
#include "keys/key_depth.hpp"
#include "sph/core/error.hpp"

namespace sph::toml_tree {
namespace {

/// Where the nodes of one document come from.
struct Origin {
  std::string name;
  bool from_override = false;
  std::string folder = from_override ? "" : std::filesystem::path(name).parent_path().string();
  [[nodiscard]] std::string where(const toml::source_region& region) const {
    if (from_override) return name;
    return fmt::format("{}:{}:{}", name, std::max(region.begin.line, 1U), std::max(region.begin.column, 1U));
  }
};

Node convert(const toml::node& from, const Origin& origin) {
  Node to;
  to.where = origin.where(from.source());
  to.folder = origin.folder;
  if (const toml::table* table = from.as_table()) {
    Table entries;
    for (const auto& [key, value] : *table)
      entries.push_back({std::string(key.str()), origin.where(key.source()), convert(value, origin)});
    to.value = std::move(entries);
  } else if (const toml::array* array = from.as_array()) {
    Array values;
    for (const toml::node& value : *array) values.push_back(convert(value, origin));
    to.value = std::move(values);
  } else if (const auto* text = from.as_string()) {
    to.value = text->get();
  } else if (const auto* whole = from.as_integer()) {
    to.value = whole->get();
  } else if (const auto* real = from.as_floating_point()) {
    to.value = real->get();
  } else if (const auto* flag = from.as_boolean()) {
    to.value = flag->get();
  }
  return to;
}

/// The value of --set: TOML if it can be read as that, otherwise the words themselves.
Node override_value(const std::string& option, const std::string& key, const std::string& value) {
  const Origin origin{option, true};
  const std::string document = "v = " + value;
  if (deep_key(document)) fail(option, key, "holds a key of too many parts", deep_key_advice);
  try {
    const toml::table parsed = toml::parse(document);
    if (parsed.size() == 1) return convert(*parsed.get("v"), origin);
  } catch (const toml::parse_error&) {
    // falls through: bare words are welcome, broken arrays and quotes are not
  }
  if (std::string_view("[{\"'").find(value.front()) != std::string_view::npos ||
      value.find('\n') != std::string::npos)
    fail(option, key, "the value is not TOML", "write a number, true, \"a text\" or [an, array]");
  return Node{option, "", value};
}

std::vector<std::string> split_path(const std::string& option, const std::string& path) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  while (true) {
    const std::size_t dot = path.find('.', begin);
    parts.push_back(path.substr(begin, dot - begin));
    if (parts.size() > most_key_parts) fail(option, "--set", "the key has too many parts", deep_key_advice);
    if (parts.back().empty()) fail(option, path, "the key has an empty part", "write --set table.key=value");
    if (dot == std::string::npos) return parts;
    begin = dot + 1;
  }
}

Node& element(Array& array, const std::string& part, const std::string& option, const std::string& path) {
  std::vector<std::string> names;
  for (Node& node : array) {
    names.push_back(name_of(node));
    if (names.back() == part) return node;
  }
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), index);
  const bool is_index = error == std::errc{} && end == part.data() + part.size();
  if (is_index && index < array.size()) return array[index];
  if (is_index)
    fail(option, path, fmt::format("there is no element {}", index),
         fmt::format("the indices are 0 to {}", static_cast<std::int64_t>(array.size()) - 1));
  std::erase(names, std::string());
  fail(option, path, fmt::format("there is no element named \"{}\"", part),
       names.empty() ? "use its index, from 0" : suggestion(part, names));
}

void assign(Table& table, const std::string& key, std::optional<Node> value, const std::string& option) {
  const auto at = std::find_if(table.begin(), table.end(), [&](const Entry& e) { return e.key == key; });
  if (!value) {
    if (at != table.end()) table.erase(at);
  } else if (at != table.end()) {
    at->where = option;
    at->value = std::move(*value);
  } else {
    table.push_back({key, option, std::move(*value)});
  }
}

Node& child(Node& node, const std::string& part, const std::string& option, const std::string& path) {
  if (auto* array = std::get_if<Array>(&node.value)) return element(*array, part, option, path);
  auto* table = std::get_if<Table>(&node.value);
  if (table == nullptr)
    fail(option, path, fmt::format("goes through {}, which has no keys", type_name(node)),
         "name a key of a table");
  for (Entry& e : *table)
    if (e.key == part) return e.value;
  table->push_back({part, option, Node{option, "", Table{}}});
  return table->back().value;
}

}  // namespace

const Table* Node::table() const { return std::get_if<Table>(&value); }
const Array* Node::array() const { return std::get_if<Array>(&value); }
const Node* Node::find(std::string_view key) const {
  if (const Table* entries = table())
    for (const Entry& e : *entries)
      if (e.key == key) return &e.value;
  return nullptr;
}

std::string name_of(const Node& node) {
  const Node* name = node.find("name");
  const std::string* text = name == nullptr ? nullptr : std::get_if<std::string>(&name->value);
  return text == nullptr ? std::string() : *text;
}

std::string_view type_name(const Node& node) {
  constexpr std::array<std::string_view, 7> names{"a date", "true or false", "a whole number", "a number",
                                                  "a text", "an array",      "a table"};
  return names[node.value.index()];
}

Node parse(std::string_view text, const std::string& file) {
  if (const std::optional<TextPlace> deep = deep_key(text))
    fail(fmt::format("{}:{}:{}", file, deep->line, deep->column), "syntax", "a key has too many parts",
         deep_key_advice);
  try {
    return convert(toml::parse(text, file), Origin{file, false});
  } catch (const toml::parse_error& e) {
    fail(Origin{file, false}.where(e.source()), "syntax", e.description(),
         "a scene is TOML: [table], key = number, key = \"text\"");
  }
}

void apply_override(Node& root, const std::string& text) {
  const std::string option = "--set " + text;
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    fail(option, "--set", "there is no \"key=value\" in it", "write --set table.key=value");
  const auto trim = [](const std::string& s) {
    const std::size_t first = s.find_first_not_of(" \t");
    return first == std::string::npos ? std::string()
                                      : s.substr(first, s.find_last_not_of(" \t") - first + 1);
  };
  const std::string path = trim(text.substr(0, equals));
  const std::string value_text = trim(text.substr(equals + 1));
  const std::vector<std::string> parts = split_path(option, path);
  std::optional<Node> value;
  if (!value_text.empty()) value = override_value(option, path, value_text);
  Node* node = &root;
  for (std::size_t k = 0; k + 1 < parts.size(); ++k) node = &child(*node, parts[k], option, path);
  if (auto* table = std::get_if<Table>(&node->value)) {
    assign(*table, parts.back(), std::move(value), option);
  } else if (!value) {
    fail(option, path, "an element of an array cannot be removed", "set the whole array");
  } else {
    child(*node, parts.back(), option, path) = std::move(*value);
  }
}

void fail(std::string_view where, std::string_view key, std::string_view what, std::string_view right) {
  std::string line = fmt::format("{}: {}: {}; {}", where, key, what, right);
  for (char& c : line)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  throw InputError(line);
}

}  // namespace sph::toml_tree
