// Words and keys that laws and terms bring with their headers (sph/core/registry.hpp): ours, and those of the program
// that reads the scene.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "keys/key.hpp"
#include "sph/laws/contact/law.hpp"
#include "sph/laws/drag/law.hpp"
#include "sph/laws/eos/law.hpp"

namespace sph::keys {

template <>
inline std::span<const ContactLaw* const> laws_of() {
  return contact_laws();
}
template <>
inline std::span<const EquationOfState* const> laws_of() {
  return equations_of_state();
}
template <>
inline std::span<const DragLaw* const> laws_of() {
  return drag_laws();
}

template <class Law>
std::span<const Word> words_of() {
  static const std::vector<Word> words = [] {
    std::vector<Word> all;
    for (const Law* law : laws_of<Law>())
      all.emplace_back(law->word, static_cast<int>(all.size()), &type_mark<Law>);
    return all;
  }();
  return words;
}
template <class Law>
inline constexpr Words law_words{{}, words_of<Law>};

/// Besides those in its list.
[[nodiscard]] std::span<const Key> more_keys(const KeyTable& table);
/// All together.
[[nodiscard]] std::vector<Key> keys_of(const KeyTable& table);
/// The one of this name; nullptr if there is none.
[[nodiscard]] const Key* find_key(const KeyTable& table, std::string_view name);

}  // namespace sph::keys
