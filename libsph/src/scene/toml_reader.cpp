#include "scene/toml_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <stdexcept>

#include "scene/nearest.hpp"
#include "sph/added_term.hpp"
#include "sph/contact/law.hpp"
#include "sph/eos/law.hpp"

namespace sph {

using toml_tree::Node;

namespace {

/// Values quoted in messages stay short.
std::string shown(std::string_view text) {
  constexpr std::size_t longest = 60;
  return text.size() <= longest ? std::string(text) : fmt::format("{}...", text.substr(0, longest));
}

std::string join_path(const std::string& path, std::string_view key) {
  if (key.empty()) key = "\"\"";
  return path.empty() ? std::string(key) : fmt::format("{}.{}", path, key);
}

/// Where a misplaced key belongs, or the nearest key of its own table.
std::string key_advice(const std::string& key, const KeyTable& own) {
  const std::vector<std::string> words = keys_of(own);
  const std::string near = nearest(key, words);
  if (near.empty())
    for (const KeyTable& other : scene_keys::all)
      if (std::ranges::count(keys_of(other), key) > 0)
        return other.name.empty() ? std::string("it belongs above the first table")
                                  : fmt::format("it belongs to [{}]", other.name);
  return suggestion(key, words);
}

}  // namespace

std::vector<std::string> keys_of(const KeyTable& table) {
  std::vector<std::string> keys(table.keys.begin(), table.keys.end());
  const auto add = [&](std::span<const LawKey> own) {
    for (const LawKey& key : own)
      if (std::ranges::find(keys, key.name) == keys.end()) keys.emplace_back(key.name);
  };
  if (table.name == scene_keys::group.name) {
    for (const ContactLaw* law : contact_laws()) add(law->keys);
    for (const EquationOfState* law : equations_of_state()) add(law->keys);
  }
  if (table.name == scene_keys::terms.name)
    for (const AddedTerm* t : added_terms()) keys.emplace_back(t->word);
  return keys;
}

TableReader::TableReader(const Node& node, std::string path, const KeyTable& keys)
    : node_(&node), path_(std::move(path)), keys_(keys) {
  if (node.table() == nullptr)
    toml_tree::fail(node.where, path_, fmt::format("is {}", type_name(node)), "it must be a table");
  const std::vector<std::string> known = keys_of(keys_);
  for (const toml_tree::Entry& e : *node.table())
    if (std::ranges::find(known, e.key) == known.end())
      toml_tree::fail(e.where, join_path(path_, shown(e.key)), "unknown key", key_advice(e.key, keys_));
}

const Node* TableReader::find(std::string_view key) const {
  if (std::ranges::count(keys_of(keys_), key) == 0)
    throw std::logic_error(fmt::format("key {} is read but not listed in scene_keys.hpp", key));
  used_.emplace(key);
  return node_->find(key);
}

std::string TableReader::path_of(std::string_view key) const { return join_path(path_, key); }

void TableReader::fail(std::string_view key, std::string_view what, std::string_view right) const {
  const Node* value = node_->find(key);
  toml_tree::fail(value == nullptr ? node_->where : value->where, path_of(key), what, right);
}

void TableReader::fail_missing(std::string_view key, std::string_view right) const {
  fail(key, "is missing", right);
}

void TableReader::fail_word(std::string_view key, const std::string& word,
                            const std::vector<std::string>& words) const {
  fail(key, fmt::format("is \"{}\"", shown(word)), suggestion(word, words));
}

void TableReader::only_if(bool condition, std::string_view key, std::string_view reason) const {
  if (!condition && has(key)) fail(key, "has no meaning here", reason);
}

void TableReader::not_both(std::string_view a, std::string_view b) const {
  if (has(a) && has(b))
    fail(b, fmt::format("contradicts {}, which is given too", a),
         fmt::format("give one of them (--set {}= removes a key)", path_of(a)));
}

void TableReader::finish() const {
  for (const toml_tree::Entry& e : *node_->table())
    if (!used_.contains(e.key)) toml_tree::fail(e.where, path_of(e.key), "has no meaning here", "remove it");
}

std::optional<std::string> TableReader::text(std::string_view key) const {
  const Node* value = find(key);
  if (value == nullptr) return std::nullopt;
  const auto* words = std::get_if<std::string>(&value->value);
  if (words == nullptr) fail(key, fmt::format("is {}", type_name(*value)), "it must be a text in quotes");
  return *words;
}

std::optional<bool> TableReader::flag(std::string_view key) const {
  const Node* value = find(key);
  if (value == nullptr) return std::nullopt;
  const auto* on = std::get_if<bool>(&value->value);
  if (on == nullptr)
    fail(key, fmt::format("is {}", type_name(*value)), "it must be true or false, without quotes");
  return *on;
}

std::optional<std::int64_t> TableReader::whole(std::string_view key, std::int64_t least,
                                               std::int64_t most) const {
  constexpr double exact_limit = 9007199254740992.0;  // 2^53: larger doubles do not count in ones
  const Node* value = find(key);
  if (value == nullptr) return std::nullopt;
  std::int64_t n = 0;
  if (const auto* i = std::get_if<std::int64_t>(&value->value)) {
    n = *i;
  } else if (const auto* d = std::get_if<double>(&value->value);
             d != nullptr && std::trunc(*d) == *d && std::fabs(*d) <= exact_limit) {
    n = static_cast<std::int64_t>(*d);
  } else {
    fail(key, fmt::format("is {}", d == nullptr ? std::string(type_name(*value)) : fmt::format("{}", *d)),
         "it must be a whole number");
  }
  if (n < least || n > most)
    fail(key, fmt::format("is {}", n),
         most == std::numeric_limits<std::int64_t>::max() ? fmt::format("it must be at least {}", least)
                                                          : fmt::format("it must be {} to {}", least, most));
  return n;
}

double TableReader::to_number(const Node& value, std::string_view key, Dimension dim) const {
  const auto bad = [&](const std::string& what, const std::string& right) {
    toml_tree::fail(value.where, path_of(key), what, right);
  };
  double x = 0;
  if (const auto* i = std::get_if<std::int64_t>(&value.value)) {
    x = static_cast<double>(*i);
  } else if (const auto* d = std::get_if<double>(&value.value)) {
    x = *d;
  } else if (const auto* words = std::get_if<std::string>(&value.value)) {
    const std::string example = dim == dimension::none ? std::string("write a number without quotes")
                                                       : fmt::format("write a number in {u} or \"5 {u}\"",
                                                                     fmt::arg("u", si_unit(dim)));
    const Quantity q = parse_quantity(*words);
    if (!q.problem.empty()) bad(fmt::format("\"{}\" {}", shown(*words), q.problem), example);
    if (!q.has_unit) bad(fmt::format("\"{}\" has no unit", shown(*words)), example);
    if (q.dim != dim)
      bad(fmt::format("\"{}\" is {}", shown(*words), describe(q.dim)),
          fmt::format("it must be {}", describe(dim)));
    x = q.value;
  } else {
    bad(fmt::format("is {}", type_name(value)), fmt::format("it must be {}", describe(dim)));
  }
  if (!std::isfinite(x)) bad(fmt::format("is {}", x), "it must be finite");
  return x;
}

std::optional<double> TableReader::number(std::string_view key, Dimension dim, Bound bound) const {
  const Node* value = find(key);
  if (value == nullptr) return std::nullopt;
  const double x = to_number(*value, key, dim);
  if (bound == Bound::positive && !(x > 0)) fail(key, fmt::format("is {}", x), "it must be positive");
  if (bound == Bound::not_negative && !(x >= 0))
    fail(key, fmt::format("is {}", x), "it must not be negative");
  return x;
}

std::optional<std::array<double, 3>> TableReader::vector(std::string_view key, Dimension dim,
                                                         int axes) const {
  const Node* value = find(key);
  if (value == nullptr) return std::nullopt;
  const std::string wanted = fmt::format("it must be an array of {} numbers (dimension = {})", axes, axes);
  const toml_tree::Array* array = value->array();
  if (array == nullptr) fail(key, fmt::format("is {}", type_name(*value)), wanted);
  if (static_cast<int>(array->size()) != axes) fail(key, fmt::format("has {} values", array->size()), wanted);
  std::array<double, 3> out{};
  for (std::size_t a = 0; a < array->size(); ++a) out[a] = to_number((*array)[a], key, dim);
  return out;
}

double TableReader::required_number(std::string_view key, Dimension dim, Bound bound) const {
  const std::optional<double> x = number(key, dim, bound);
  if (!x) fail_missing(key, fmt::format("give {}", describe(dim)));
  return *x;
}

std::array<double, 3> TableReader::required_vector(std::string_view key, Dimension dim, int axes) const {
  const std::optional<std::array<double, 3>> x = vector(key, dim, axes);
  if (!x) fail_missing(key, fmt::format("give an array of {} numbers", axes));
  return *x;
}

std::string TableReader::required_text(std::string_view key) const {
  const std::optional<std::string> words = text(key);
  if (!words) fail_missing(key, "give a text in quotes");
  return *words;
}

std::string TableReader::file_path(std::string_view key, const std::string& scene_file) const {
  const std::optional<std::string> words = text(key);
  if (!words) return {};
  if (words->empty()) fail(key, "is empty", "give the path of a file");
  std::filesystem::path path(*words);
  if (path.is_relative() && !node_->find(key)->from_override)
    path = std::filesystem::path(scene_file).parent_path() / path;
  return std::filesystem::absolute(path).lexically_normal().string();
}

TableReader TableReader::table(std::string_view key, const KeyTable& keys) const {
  const Node* value = find(key);
  if (value != nullptr) return {*value, path_of(key), keys};
  auto empty = std::make_shared<const Node>(Node{node_->where, false, toml_tree::Table{}});
  TableReader reader(*empty, path_of(key), keys);
  reader.stand_in_ = std::move(empty);
  return reader;
}

std::vector<TableReader> TableReader::tables(std::string_view key, const KeyTable& keys) const {
  std::vector<TableReader> out;
  const Node* value = find(key);
  if (value == nullptr) return out;
  const toml_tree::Array* array = value->array();
  if (array == nullptr)
    fail(key, fmt::format("is {}", type_name(*value)), fmt::format("write it as [[{}]]", keys.name));
  for (std::size_t k = 0; k < array->size(); ++k) {
    const Node* name = (*array)[k].find("name");
    const auto* words = name == nullptr ? nullptr : std::get_if<std::string>(&name->value);
    const std::string label = words == nullptr || words->empty() ? fmt::format("{}", k) : *words;
    out.emplace_back((*array)[k], join_path(path_of(key), shown(label)), keys);
  }
  return out;
}

}  // namespace sph
