// [contact] and [[contact.pair]]: how grains act on each other and on walls where they touch.
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>

#include "keys/scene_resolve.hpp"

namespace sph {
namespace {

ContactPair read_pair(const Reader<keys::contact_pair>& table) {
  ContactPair pair;
  table.read(pair);
  std::sort(pair.groups.begin(), pair.groups.end());
  if (!pair.friction && !pair.rolling_friction && !pair.restitution)
    table.fail_missing("friction", "give it, rolling_friction or restitution: the pair says nothing else");
  table.finish();
  return pair;
}

}  // namespace

void read_contact_law(const Reader<keys::contact>& table, Scene& scene) {
  table.read(scene.grains.contact);
  std::vector<std::string> by_rate;
  for (const ContactLaw* law : contact_laws())
    if (law->by_rate != nullptr) by_rate.emplace_back(law->word);
  table.only_if(
      scene.grains.contact.law->by_rate != nullptr, "normal_damping",
      fmt::format("it is of law = {}; this one takes the restitution of its groups", either(by_rate)));
}

std::vector<ContactPair> read_contact_pairs(const Reader<keys::contact>& table) {
  std::vector<ContactPair> pairs;
  for (const auto& t : table.tables<keys::contact_pair>()) {
    const ContactPair pair = read_pair(t);
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
