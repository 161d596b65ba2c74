#include "keys/toml_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>

#include "core/nearest.hpp"
#include "keys/law_keys.hpp"

namespace sph {

using toml_tree::Node;

namespace {

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

std::optional<KeyValue> TableReader::value(const Key& key) const {
  const Node* node = find(key);
  return node == nullptr ? std::nullopt
                         : std::optional<KeyValue>(std::in_place, key, *node, path_of(key), *scene_);
}

std::string TableReader::path_of(const Key& key) const { return join_path(path_, key.name); }

void TableReader::fail(const Key& key, std::string_view what, std::string_view right) const {
  const Node* value = node_->find(key.name);
  toml_tree::fail(value == nullptr ? node_->where : value->where, path_of(key), what, right);
}

void TableReader::fail_missing(const Key& key, std::string_view right) const {
  fail(key, "is missing", right);
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
    if (where.holds(word)) continue;
    only_if(false, key, keys::refusal(*keys_, where));
    return false;
  }
  return true;
}

void TableReader::read(void* owner) const {
  // What is out of place says more than what is missing. Words stand before the keys that depend on them, by
  // name or through the scene that holds `owner`.
  const auto put = [&](const Key& key) {
    if (const std::optional<KeyValue> given = value(key)) given->put(key.member.in(owner));
  };
  for (const Key& key : keys_->keys) {
    if (!applies(key) || !std::holds_alternative<keys::Words>(key.kind)) continue;
    if (key.member.in != nullptr)
      put(key);
    else
      (void)get<&KeyValue::choice>(key);
  }
  for (const Key& key : keys::more_keys(*keys_)) (void)applies(key);
  for (const Key& key : keys_->keys) {
    if (!applies(key)) continue;
    if (key.required) require(key);
    if (key.member.in != nullptr) put(key);
  }
}

TableReader::Part TableReader::part(const keys::KeyTable& inner) const {
  const Key& key = (*keys_)[inner.own_name()];
  if (const Node* value = find(key)) return {value, path_of(key), nullptr};
  auto empty = std::make_shared<const Node>(Node{node_->where, node_->folder, toml_tree::Table{}});
  return {empty.get(), path_of(key), empty};
}

std::vector<TableReader::Part> TableReader::parts(const keys::KeyTable& inner) const {
  const Key& key = (*keys_)[inner.own_name()];
  std::vector<Part> out;
  const std::optional<KeyValue> given = value(key);
  if (!given) return out;
  const toml_tree::Array& array = given->array("write it as " + keys::header(inner));
  for (std::size_t k = 0; k < array.size(); ++k) {
    const std::string name = name_of(array[k]);
    out.push_back(
        {&array[k], join_path(path_of(key), name.empty() ? fmt::format("{}", k) : shown(name)), nullptr});
  }
  return out;
}

}  // namespace sph
