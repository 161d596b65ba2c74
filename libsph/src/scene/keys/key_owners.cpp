#include "scene/keys/key_owners.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "scene/keys/all_keys.hpp"

namespace sph::keys {
namespace {

std::string meaning_of(const LawKey& key) {
  const Range range{.least = key.above, .most = key.most, .above_least = true};
  const std::string otherwise = key.otherwise == nullptr   ? "required"
                                : key.default_text.empty() ? "with a default"
                                                           : fmt::format("default {}", key.default_text);
  return fmt::format("{}, {}, {}", describe(key.dimension), text_of(range), otherwise);
}

/// A default is a function: two that say the same in words are one.
bool is_same(const LawKey& a, const LawKey& b) {
  const bool both = a.otherwise != nullptr && b.otherwise != nullptr;
  const bool one_default =
      a.otherwise == b.otherwise || (both && !a.default_text.empty() && a.default_text == b.default_text);
  return a.dimension == b.dimension && a.above == b.above && a.most == b.most && one_default;
}

/// Its table has it for those who read it, and says no more than what it is measured in.
bool is_open(const Key& key, const LawKey& as) {
  const auto* number = std::get_if<Number>(&key.kind);
  return number != nullptr && number->dim == as.dimension && text_of(number->range).empty() &&
         key.member.in == nullptr && key.scenes.holds == nullptr && key.where[0].key.empty();
}

}  // namespace

void refuse_taken_keys(const KeyOwner& law) {
  const auto refuse = [&](const LawKey& key, const std::string& why) {
    throw std::logic_error(
        fmt::format("{} \"{}\": its key {} {}: give it another name", law.sort, law.word, key.name, why));
  };
  for (const LawKey& key : law.keys) {
    if (std::ranges::count(law.keys, key.name, &LawKey::name) > 1) refuse(key, "is in its list twice");
    if (const Key* own = group.find(key.name); own != nullptr && !is_open(*own, key))
      refuse(key, "is a key of [[group]] already, where it has a meaning of its own");
  }
  for (const std::vector<KeyOwner>& laws : {contact_law_keys(), equation_of_state_keys()})
    for (const KeyOwner& other : laws)
      for (const LawKey& key : law.keys)
        for (const LawKey& theirs : other.keys) {
          if (theirs.name != key.name || (other.sort == law.sort && is_same(theirs, key))) continue;
          refuse(key, fmt::format("({}) is one of the {} \"{}\" already ({})", meaning_of(key), other.sort,
                                  other.word, meaning_of(theirs)));
        }
}

void refuse_taken_term(std::string_view word) {
  if (terms.find(word) != nullptr)
    throw std::logic_error(
        fmt::format("term \"{}\": its word is a key of [terms] already, where it has a meaning of its own: "
                    "give it another",
                    word));
}

}  // namespace sph::keys
