#include "keys/toml_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <stdexcept>

#include "core/nearest.hpp"
#include "keys/law_keys.hpp"

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
std::string key_advice(const std::string& key, const keys::KeyTable& own) {
  std::vector<std::string> words;
  for (const Key& k : own.keys) words.emplace_back(k.name);
  for (const Key& k : keys::more_keys(own)) words.emplace_back(k.name);
  if (nearest(key, words).empty())
    for (const keys::KeyTable* other : keys::all)
      if (keys::find_key(*other, key) != nullptr)
        return other->name.empty() ? std::string("it belongs above the first table")
                                   : fmt::format("it belongs to [{}]", other->name);
  return suggestion(key, words);
}

}  // namespace

TableReader::TableReader(const Node& node, std::string path, const keys::KeyTable& keys, const Scene& scene)
    : scene_(&scene), node_(&node), path_(std::move(path)), keys_(&keys) {
  if (node.table() == nullptr)
    toml_tree::fail(node.where, path_, fmt::format("is {}", type_name(node)), "it must be a table");
  for (const toml_tree::Entry& e : *node.table())
    if (keys::find_key(keys, e.key) == nullptr)
      toml_tree::fail(e.where, join_path(path_, shown(e.key)), "unknown key", key_advice(e.key, keys));
}

const Node* TableReader::find(const Key& key) const {
  used_.insert(key.name);
  return node_->find(key.name);
}

std::string TableReader::path_of(const Key& key) const { return join_path(path_, key.name); }

void TableReader::fail(const Key& key, std::string_view what, std::string_view right) const {
  const Node* value = node_->find(key.name);
  toml_tree::fail(value == nullptr ? node_->where : value->where, path_of(key), what, right);
}

void TableReader::fail_missing(const Key& key, std::string_view right) const {
  fail(key, "is missing", right);
}

void TableReader::fail_word(const Key& key, const std::string& word,
                            const std::vector<std::string>& words) const {
  fail(key, fmt::format("is \"{}\"", shown(word)), suggestion(word, words));
}

void TableReader::only_if(bool condition, const Key& key, std::string_view reason) const {
  if (!condition && has(key)) fail(key, "has no meaning here", reason);
}

void TableReader::not_both(const Key& a, const Key& b) const {
  if (has(a) && has(b))
    fail(b, fmt::format("contradicts {}, which is given too", a.name),
         fmt::format("give one of them (--set {}= removes a key)", path_of(a)));
}

void TableReader::require(const Key& key) const {
  if (has(key)) return;
  const bool vector = std::holds_alternative<keys::Vector>(key.kind);
  fail_missing(key, vector ? fmt::format("give an array of {} numbers", scene_->dim)
                           : "give " + keys::text_of(key.kind));
}

void TableReader::finish() const {
  for (const toml_tree::Entry& e : *node_->table())
    if (!used_.contains(e.key))
      toml_tree::fail(e.where, join_path(path_, e.key), "has no meaning here", "remove it");
}

bool TableReader::applies(const Key& key) const {
  if (key.scenes.holds != nullptr && !key.scenes.holds(*scene_)) {
    only_if(false, key, key.scenes.why);
    return false;
  }
  for (const keys::Where& where : key.where) {
    if (where.key.empty()) continue;
    const Key& selector = (*keys_)[where.key];
    const Node* value = node_->find(selector.name);
    const auto* given = value == nullptr ? nullptr : std::get_if<std::string>(&value->value);
    const std::string_view word =
        given == nullptr ? std::get<keys::Words>(selector.kind).all().front().text : std::string_view(*given);
    if ((word == where.word) == where.but.empty()) continue;
    only_if(false, key, keys::refusal(*keys_, where));
    return false;
  }
  return true;
}

void TableReader::read(void* owner) const {
  // What is out of place says more than what is missing. Words stand before the keys that depend on them, by
  // name or through the scene that holds `owner`.
  for (const Key& key : keys_->keys) {
    if (!applies(key) || !std::holds_alternative<keys::Words>(key.kind)) continue;
    if (key.member.in != nullptr)
      put(key, key.member.in(owner));
    else
      (void)choice(key);
  }
  for (const Key& key : keys::more_keys(*keys_)) (void)applies(key);
  for (const Key& key : keys_->keys) {
    if (!applies(key)) continue;
    if (key.required) require(key);
    if (key.member.in != nullptr) put(key, key.member.in(owner));
  }
}

void TableReader::put(const Key& key, const keys::Value& to) const {
  const auto set = [](auto& target, const auto& found) {
    if (found) target = *found;
  };
  std::visit(
      [&]<class T>(T at) {
        if constexpr (std::is_same_v<T, keys::Enumerator>) {
          if (const std::optional<int> n = choice(key)) at.set(at.at, *n);
        } else if constexpr (std::is_same_v<T, keys::Named>) {
          set(*at.index, index(key));
        } else if constexpr (std::is_same_v<T, double*> || std::is_same_v<T, std::optional<double>*>) {
          set(*at, number(key));
        } else if constexpr (std::is_same_v<T, Double3*> || std::is_same_v<T, std::optional<Double3>*>) {
          set(*at, vector(key, std::get<keys::Vector>(key.kind).dim));
        } else if constexpr (std::is_same_v<T, bool*> || std::is_same_v<T, std::optional<bool>*>) {
          set(*at, flag(key));
        } else if constexpr (std::is_same_v<T, std::array<bool, 3>*>) {
          set(*at, flags(key));
        } else if constexpr (std::is_same_v<T, std::array<int, 2>*>) {
          set(*at, two_groups(key));
        } else if constexpr (std::is_same_v<T, std::array<std::int64_t, 3>*>) {
          set(*at, copies(key));
        } else if constexpr (std::is_same_v<T, std::string*>) {
          set(*at, std::holds_alternative<keys::File>(key.kind) ? file(key) : text(key));
        } else if (const std::optional<std::int64_t> n = whole(key)) {
          *at = static_cast<std::remove_pointer_t<T>>(*n);
        }
      },
      to);
}

template <class T>
const T* TableReader::value(const Key& key, std::string_view wanted) const {
  const Node* node = find(key);
  if (node == nullptr) return nullptr;
  const T* found = std::get_if<T>(&node->value);
  if (found == nullptr) fail(key, fmt::format("is {}", type_name(*node)), wanted);
  return found;
}

const toml_tree::Array* TableReader::array(const Key& key, std::size_t size, std::string_view wanted) const {
  const auto* found = value<toml_tree::Array>(key, wanted);
  if (found != nullptr && found->size() != size)
    fail(key, fmt::format("has {} values", found->size()), wanted);
  return found;
}

template <class T>
const T& TableReader::item(const Key& key, const Node& node, std::string_view wanted) const {
  const T* found = std::get_if<T>(&node.value);
  if (found == nullptr) fail(key, fmt::format("holds {}", type_name(node)), wanted);
  return *found;
}

std::optional<std::string> TableReader::text(const Key& key) const {
  const auto* words = value<std::string>(key, "it must be a text in quotes");
  return words == nullptr ? std::nullopt : std::optional(*words);
}

std::string TableReader::required_text(const Key& key) const {
  require(key);
  return *text(key);
}

std::optional<bool> TableReader::flag(const Key& key) const {
  const auto* on = value<bool>(key, "it must be true or false, without quotes");
  return on == nullptr ? std::nullopt : std::optional(*on);
}

std::optional<std::array<bool, 3>> TableReader::flags(const Key& key) const {
  const auto axes = static_cast<std::size_t>(scene_->dim);
  const std::string wanted =
      fmt::format("it must be an array of {} true or false (dimension = {})", axes, axes);
  const toml_tree::Array* values = array(key, axes, wanted);
  if (values == nullptr) return std::nullopt;
  std::array<bool, 3> out{};
  for (std::size_t a = 0; a < axes; ++a) out[a] = item<bool>(key, (*values)[a], wanted);
  return out;
}

std::optional<int> TableReader::choice(const Key& key) const {
  const std::optional<std::string> word = text(key);
  if (!word) return std::nullopt;
  std::vector<std::string> words;
  for (const keys::Word& w : std::get<keys::Words>(key.kind).all()) {
    if (w.text == *word) return w.value;
    words.emplace_back(w.text);
  }
  fail_word(key, *word, words);
}

int TableReader::index_of(const Key& key, const std::string& name, std::string_view what) const {
  std::vector<std::string> names;
  if (what == "group")
    for (const Group& group : scene_->groups) names.push_back(group.name);
  else
    for (const Wall& wall : scene_->walls) names.push_back(wall.name);
  const auto at = std::find(names.begin(), names.end(), name);
  if (at == names.end())
    fail(key, fmt::format("names the unknown {} \"{}\"", what, name),
         names.empty() ? fmt::format("describe it in a [[{}]] table", what) : suggestion(name, names));
  return static_cast<int>(at - names.begin());
}

std::optional<int> TableReader::index(const Key& key) const {
  const std::optional<std::string> name = text(key);
  if (!name) return std::nullopt;
  const auto& [what, or_none, of_grains] = std::get<keys::NameOf>(key.kind);
  const int found = or_none && *name == "none" ? -1 : index_of(key, *name, what);
  if (of_grains) require_grains(key, found);
  return found;
}

void TableReader::require_grains(const Key& key, int group) const {
  if (const Group& g = scene_->groups[static_cast<std::size_t>(group)]; g.kind != GroupKind::grain)
    fail(key, fmt::format("names \"{}\", which is not of grains", g.name),
         "name a group with kind = \"grain\"");
}

std::optional<std::array<int, 2>> TableReader::two_groups(const Key& key) const {
  const std::string wanted = "give " + keys::text_of(key.kind);
  const toml_tree::Array* names = array(key, 2, wanted);
  if (names == nullptr) return std::nullopt;
  std::array<int, 2> out{};
  for (std::size_t k = 0; k < 2; ++k)
    out[k] = index_of(key, item<std::string>(key, (*names)[k], wanted), "group");
  if (std::get<keys::TwoGroups>(key.kind).of_grains)
    for (const int group : out) require_grains(key, group);
  return out;
}

std::optional<std::array<std::int64_t, 3>> TableReader::copies(const Key& key) const {
  constexpr std::int64_t most = 1'000'000;  // along one axis
  const std::string_view wanted = "it must be an array of three whole numbers, like [4, 4, 1]";
  const toml_tree::Array* counts = array(key, 3, wanted);
  if (counts == nullptr) return std::nullopt;
  std::array<std::int64_t, 3> out{};
  for (std::size_t a = 0; a < 3; ++a) {
    out[a] = item<std::int64_t>(key, (*counts)[a], wanted);
    if (out[a] < 1 || out[a] > most)
      fail(key, fmt::format("is {} in {}", out[a], "xyz"[a]), fmt::format("it must be 1 to {}", most));
  }
  return out;
}

std::optional<std::int64_t> TableReader::whole(const Key& key) const {
  constexpr double exact_limit = 9007199254740992.0;  // 2^53: larger doubles do not count in ones
  const auto [least, most] = std::get<keys::Whole>(key.kind);
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

double TableReader::to_number(const Node& value, const Key& key, Dimension dim) const {
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

std::optional<double> TableReader::number(const Key& key) const {
  const Node* value = find(key);
  if (value == nullptr) return std::nullopt;
  const auto& [dim, range] = std::get<keys::Number>(key.kind);
  const double x = to_number(*value, key, dim);
  if (!range.holds(x)) fail(key, fmt::format("is {}", x), keys::wanted(range, x));
  return x;
}

std::optional<Double3> TableReader::vector(const Key& key, Dimension dim) const {
  const auto axes = static_cast<std::size_t>(scene_->dim);
  const toml_tree::Array* values =
      array(key, axes, fmt::format("it must be an array of {} numbers (dimension = {})", axes, axes));
  if (values == nullptr) return std::nullopt;
  Double3 out{};
  for (std::size_t a = 0; a < axes; ++a) out[a] = to_number((*values)[a], key, dim);
  return out;
}

std::optional<std::string> TableReader::file(const Key& key) const {
  const std::optional<std::string> words = text(key);
  if (!words) return std::nullopt;
  if (words->empty()) fail(key, "is empty", "give the path of a file");
  std::filesystem::path path(*words);
  if (path.is_relative() && !node_->find(key.name)->from_override)
    path = std::filesystem::path(scene_->file).parent_path() / path;
  return std::filesystem::absolute(path).lexically_normal().string();
}

TableReader::Part TableReader::part(const keys::KeyTable& inner) const {
  const Key& key = (*keys_)[inner.own_name()];
  if (const Node* value = find(key)) return {value, path_of(key), nullptr};
  auto empty = std::make_shared<const Node>(Node{node_->where, false, toml_tree::Table{}});
  return {empty.get(), path_of(key), empty};
}

std::vector<TableReader::Part> TableReader::parts(const keys::KeyTable& inner) const {
  const Key& key = (*keys_)[inner.own_name()];
  std::vector<Part> out;
  const auto* array = value<toml_tree::Array>(key, "write it as " + keys::header(inner));
  if (array == nullptr) return out;
  for (std::size_t k = 0; k < array->size(); ++k) {
    const Node* name = (*array)[k].find("name");
    const auto* words = name == nullptr ? nullptr : std::get_if<std::string>(&name->value);
    const std::string label = words == nullptr || words->empty() ? fmt::format("{}", k) : *words;
    out.push_back({&(*array)[k], join_path(path_of(key), shown(label)), nullptr});
  }
  return out;
}

}  // namespace sph
