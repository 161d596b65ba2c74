#include "keys/law_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <string>

#include "keys/all_keys.hpp"
#include "sph/terms/added_term.hpp"

namespace sph::keys {
namespace {

/// What keys say is kept as long as the program.
std::string_view kept(std::string text) {
  static std::deque<std::string> all;
  return all.emplace_back(std::move(text));
}

/// Of all laws of a sort; one that several have is there once, with the words of all.
template <class Law>
void add_keys_of_laws(std::vector<Key>& keys, std::string_view choice, Where where) {
  for (const Law* law : laws_of<Law>())
    for (const LawKey& key : law->keys) {
      const auto known = [&](const Key& k) { return k.name == key.name; };
      if (group.find(key.name) != nullptr || std::ranges::any_of(keys, known)) continue;
      std::string owners;
      for (const Law* other : laws_of<Law>())
        if (std::ranges::any_of(other->keys, [&](const LawKey& k) { return k.name == key.name; }))
          owners += fmt::format("{}\"{}\"", owners.empty() ? "" : " or ", other->word);
      const Range range{.least = key.above, .most = key.most, .above_least = true};
      const std::string_view says = kept(fmt::format("With {} = {}. {}", choice, owners, key.sentence));
      if (key.otherwise == nullptr)
        keys.emplace_back(key.name, Number{key.dimension, range}, says, where,
                          Default{kept(fmt::format("required with {} = {}", choice, owners))});
      else
        keys.emplace_back(key.name, Number{key.dimension, range}, says, where, Default{key.default_text});
    }
}

}  // namespace

std::span<const Key> more_keys(const KeyTable& table) {
  static const std::vector<Key> of_groups = [] {
    std::vector<Key> keys;
    add_keys_of_laws<EquationOfState>(keys, "eos", of_sph);
    add_keys_of_laws<ContactLaw>(keys, "contact.law", grain);
    return keys;
  }();
  static const std::vector<Key> of_terms = [] {
    std::vector<Key> keys;
    for (const AddedTerm* t : added_terms())
      keys.emplace_back(
          t->word, Number{dimension::none, up_to(t->most, "it must be")}, t->sentence,
          t->fusions.front().values.has(sph::Value::stress) ? of_added_stresses : of_added_terms,
          Default{"0"});
    return keys;
  }();
  if (&table == &group) return of_groups;
  if (&table == &terms) return of_terms;
  return {};
}

std::vector<Key> keys_of(const KeyTable& table) {
  std::vector<Key> keys(table.keys.begin(), table.keys.end());
  keys.insert(keys.end(), more_keys(table).begin(), more_keys(table).end());
  return keys;
}

const Key* find_key(const KeyTable& table, std::string_view name) {
  if (const Key* key = table.find(name)) return key;
  for (const Key& key : more_keys(table))
    if (key.name == name) return &key;
  return nullptr;
}

}  // namespace sph::keys
