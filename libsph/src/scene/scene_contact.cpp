// [contact] and [[contact.pair]]: how grains act on each other and on walls where they touch.
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>

#include "scene/scene_resolve.hpp"
#include "sph/contact/law.hpp"

namespace sph {
namespace {

constexpr double most_overlap = 0.5;

std::array<int, 2> read_pair_groups(const TableReader& table, const std::vector<Group>& groups) {
  const toml_tree::Node* value = table.find("groups");
  if (value == nullptr) table.fail_missing("groups", "give the names of two groups, [\"a\", \"b\"]");
  const toml_tree::Array* names = value->array();
  if (names == nullptr || names->size() != 2)
    table.fail("groups", "must be an array of two names", "for example [\"sand\", \"glass\"]");
  std::array<int, 2> out{};
  for (std::size_t k = 0; k < 2; ++k) {
    const auto* name = std::get_if<std::string>(&(*names)[k].value);
    if (name == nullptr)
      table.fail("groups", fmt::format("holds {}", type_name((*names)[k])), "give the names of two groups");
    out[k] = group_of_name(table, "groups", *name, groups);
  }
  std::sort(out.begin(), out.end());
  return out;
}

ContactPair read_pair(const TableReader& table, const Scene& scene) {
  ContactPair pair;
  pair.groups = read_pair_groups(table, scene.groups);
  pair.friction = table.number("friction", dimension::none, Bound::not_negative);
  pair.rolling_friction = table.number("rolling_friction", dimension::none, Bound::not_negative);
  table.only_if(!scene.contact.normal_damping, "restitution", "contact.normal_damping stands instead of it");
  pair.restitution = table.number("restitution", dimension::none, Bound::positive);
  if (pair.restitution && *pair.restitution > 1)
    table.fail("restitution", fmt::format("is {}", *pair.restitution), "it must be above 0 and at most 1");
  if (!pair.friction && !pair.rolling_friction && !pair.restitution)
    table.fail_missing("friction", "give it, rolling_friction or restitution: the pair says nothing else");
  table.finish();
  return pair;
}

}  // namespace

ContactControl read_contact_law(const TableReader& table) {
  ContactControl contact;
  std::vector<std::string> laws, by_rate;
  for (const ContactLaw* law : contact_laws()) {
    laws.emplace_back(law->word);
    if (law->by_rate != nullptr) by_rate.emplace_back(law->word);
  }
  const std::optional<const ContactLaw*> law = table.choice("law", contact_law_words());
  if (!law) table.fail_missing("law", "give " + either(laws));
  contact.law = *law;
  table.only_if(
      contact.law->by_rate != nullptr, "normal_damping",
      fmt::format("it is of law = {}; this one takes the restitution of its groups", either(by_rate)));
  contact.normal_damping = table.number("normal_damping", dimension::rate, Bound::not_negative);
  contact.tangential_damping =
      table.number("tangential_damping", dimension::none, Bound::not_negative).value_or(0);
  if (contact.tangential_damping > 1)
    table.fail("tangential_damping", fmt::format("is {}", contact.tangential_damping),
               "it is a fraction of the normal dashpot, 0 to 1");
  contact.rolling_damping =
      table.number("rolling_damping", dimension::none, Bound::not_negative).value_or(contact.rolling_damping);
  if (contact.rolling_damping > 1)
    table.fail("rolling_damping", fmt::format("is {}", contact.rolling_damping),
               "it is a fraction of the critical dashpot, 0 to 1");
  contact.pull = table.flag("pull").value_or(false);
  contact.largest_overlap =
      table.number("largest_overlap", dimension::none, Bound::positive).value_or(contact.largest_overlap);
  if (contact.largest_overlap > most_overlap)
    table.fail("largest_overlap", fmt::format("is {}", contact.largest_overlap),
               fmt::format("it is in radii of the smaller grain, at most {}", most_overlap));
  return contact;
}

std::vector<ContactPair> read_contact_pairs(const TableReader& table, const Scene& scene) {
  std::vector<ContactPair> pairs;
  for (const TableReader& t : table.tables("pair", scene_keys::contact_pair)) {
    const ContactPair pair = read_pair(t, scene);
    for (const ContactPair& other : pairs)
      if (other.groups == pair.groups)
        t.fail("groups", "names a pair that an earlier [[contact.pair]] has",
               "write all values of a pair in one");
    pairs.push_back(pair);
  }
  table.finish();
  return pairs;
}

}  // namespace sph
