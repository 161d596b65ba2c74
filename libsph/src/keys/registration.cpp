#include "keys/registration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "keys/all_keys.hpp"
#include "laws/registries.hpp"
#include "terms/term_registry.hpp"

namespace sph {
namespace keys {
namespace {

constexpr std::string_view contact_sort = "contact law", eos_sort = "equation of state";

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

template <class Law>
void add_owners(std::vector<KeyOwner>& owners, std::string_view sort, const Registry<Law>& laws) {
  for (const Law* law : laws.so_far()) owners.push_back({sort, law->word, law->keys});
}

}  // namespace

std::vector<KeyOwner> key_owners() {
  std::vector<KeyOwner> found;
  add_owners(found, contact_sort, contact_law_registry());
  add_owners(found, eos_sort, eos_registry());
  return found;
}

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
  for (const KeyOwner& other : key_owners())
    for (const LawKey& key : law.keys)
      for (const LawKey& theirs : other.keys) {
        if (theirs.name != key.name || (other.sort == law.sort && is_same(theirs, key))) continue;
        refuse(key, fmt::format("({}) is one of the {} \"{}\" already ({})", meaning_of(key), other.sort,
                                other.word, meaning_of(theirs)));
      }
}

}  // namespace keys

void register_contact_law(const ContactLaw& law) {
  keys::refuse_taken_keys({keys::contact_sort, law.word, law.keys});
  contact_law_registry().add(law);
}

void register_equation_of_state(const EquationOfState& law) {
  keys::refuse_taken_keys({keys::eos_sort, law.word, law.keys});
  eos_registry().add(law);
}

void register_drag_law(const DragLaw& law) { drag_law_registry().add(law); }

void register_term(const AddedTerm& term) {
  if (keys::terms.find(term.word) != nullptr)
    throw std::logic_error(
        fmt::format("term \"{}\": its word is a key of [terms] already, where it has a meaning of its own: "
                    "give it another",
                    term.word));
  term_registry().add(term);
}

}  // namespace sph
