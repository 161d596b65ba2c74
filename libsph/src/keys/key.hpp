// One key of a scene. All that is known of it stands in its entry of a table (keys/*_keys.hpp): what values it
// may have, where it has a meaning, its default, the member of the scene that holds it, and what it means. The
// reader, the writer, their refusals and every reference (peperite keys) follow from that.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>

#include "keys/member.hpp"
#include "keys/units.hpp"
#include "keys/words.hpp"

namespace sph::keys {

/// The numbers from `least` to `most`. `is` says what such a number is, where that says why.
struct Range {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool above_least = false, below_most = false;  ///< the end itself is excluded
  std::string_view is = "it must be";

  [[nodiscard]] constexpr bool holds(double x) const {
    return (above_least ? x > least : x >= least) && (below_most ? x < most : x <= most);
  }
};
inline constexpr Range any{};
inline constexpr Range positive{.least = 0, .above_least = true};
inline constexpr Range not_negative{.least = 0};
constexpr Range up_to(double most, std::string_view is) { return {.least = 0, .most = most, .is = is}; }

/// "0 to 2", "above 1", "positive"; empty if every number will do.
[[nodiscard]] std::string text_of(const Range& range);
/// The sentence for `x`, which is not in the range.
[[nodiscard]] std::string wanted(const Range& range, double x);

struct KeyTable;

// What the value of a key is.
struct Number {
  Dimension dim;
  Range range = any;
};
struct Vector {  ///< as many numbers as the scene has dimensions
  Dimension dim;
};
struct Whole {
  std::int64_t least = 0;
  std::int64_t most = std::numeric_limits<std::int64_t>::max();
};
struct Flag {};
struct Flags {};  ///< one for each dimension
struct Text {};
struct File {};
struct NameOf {  ///< of a [[group]] or a [[wall]], kept as its index
  std::string_view what;
  bool or_none = false;    ///< "none" is -1
  bool of_grains = false;  ///< of those groups alone
};
struct TwoGroups {  ///< an array of their names
  std::string_view is;
  bool of_grains = false;
};
struct Copies {};  ///< whole numbers along each axis
struct Inner {     ///< a table, or an array of them
  const KeyTable* table;
};
struct Special {  ///< read by code of its own: what it is, to follow "give", an example, and as a JSON schema
  std::string_view is, example, schema;
};
using Kind = std::variant<Number, Vector, Whole, Flag, Flags, Text, File, Words, NameOf, TwoGroups, Copies,
                          Inner, Special>;

/// What a scene must be to have a key: `of` names such scenes, `why` tells others why they have none.
struct Condition {
  bool (*holds)(const Scene&) = nullptr;
  std::string_view of, why;
};

/// A key of some elements of its table: of those whose `key` is `word` (absent, it is the first of its words) or,
/// if `but` says why, of all others; `or_word` and `or_third` are other such words.
struct Where {
  std::string_view key, word, more, but, or_word, or_third;
  [[nodiscard]] constexpr bool holds(std::string_view is) const {
    return (is == word || (!is.empty() && (is == or_word || is == or_third))) == but.empty();
  }
};
constexpr Where where(std::string_view key, std::string_view word, std::string_view more = {}) {
  return {key, word, more, {}, {}, {}};
}
constexpr Where among(std::string_view key, std::string_view word, std::string_view or_word,
                      std::string_view or_third = {}) {
  return {key, word, {}, {}, or_word, or_third};
}
constexpr Where unless(std::string_view key, std::string_view word, std::string_view but,
                       std::string_view or_word = {}) {
  return {key, word, {}, but, or_word, {}};
}

/// Of a key that must be there.
struct Required {};
inline constexpr Required required;
/// In words, where it is not simply what its member begins with.
struct Default {
  std::string_view words;
};

struct Key {
  std::string_view name;
  Kind kind;
  std::string_view sentence;
  Member member;
  Condition scenes;
  std::array<Where, 2> where{};  ///< all of them must hold
  std::string_view otherwise;
  bool required = false;

  /// `facts`, in any order: where it is kept, where it has a meaning, required or another default.
  template <class... Fact>
  constexpr Key(std::string_view n, Kind k, std::string_view says, const Fact&... facts)
      : name(n), kind(k), sentence(says) {
    (add(facts), ...);
  }

 private:
  constexpr void add(const Member& m) { member = m; }
  constexpr void add(const Condition& c) { scenes = c; }
  constexpr void add(const Where& w) {
    if (!where[1].key.empty()) throw std::logic_error("where a key has a meaning depends on three words");
    where[where[0].key.empty() ? 0 : 1] = w;
  }
  constexpr void add(const Default& d) { otherwise = d.words; }
  constexpr void add(const Required&) { required = true; }
};

struct KeyTable {
  std::string_view name;  ///< as in its header, empty for the top level
  bool array = false;     ///< [[name]]
  std::string_view sentence;
  std::span<const Key> keys;
  std::string_view plural{};  ///< of what it describes, for "only groups with ..."

  /// As it stands in the table around it: "region" of "start.region".
  [[nodiscard]] constexpr std::string_view own_name() const { return name.substr(name.rfind('.') + 1); }
  [[nodiscard]] constexpr const Key* find(std::string_view key) const {
    for (const Key& k : keys)
      if (k.name == key) return &k;
    return nullptr;
  }
  [[nodiscard]] constexpr const Key& operator[](std::string_view key) const {
    const Key* found = find(key);
    if (found == nullptr) throw std::logic_error("this table of the scene has no such key");
    return *found;
  }
};

/// A table whose keys are kept in an `Owner`.
template <class Owner_>
struct Table : KeyTable {
  using Owner = Owner_;
  consteval explicit Table(const KeyTable& t) : KeyTable(t) {
    for (const Key& key : keys) {
      if (&(*this)[key.name] != &key) throw std::logic_error("two keys have one name");
      if (!key.sentence.ends_with('.')) throw std::logic_error("the sentence of a key ends with a full stop");
      if (key.member.owner != nullptr && key.member.owner != &type_mark<Owner>)
        throw std::logic_error("the member is of another struct than its table");
      for (const Where& w : key.where)
        if (!w.key.empty() && !std::get<Words>((*this)[w.key].kind).has(w.word))
          throw std::logic_error("where a key has a meaning depends on a word that is none");
      if (const auto* inner = std::get_if<Inner>(&key.kind);
          inner != nullptr && inner->table->own_name() != key.name)
        throw std::logic_error("a table has another name than its key");
    }
  }
};

/// The header of a table, "[kernel]" or "[[group]]".
[[nodiscard]] std::string header(const KeyTable& table);
/// What a value of the kind is, to follow "give": "a length (m)", "a text in quotes".
[[nodiscard]] std::string text_of(const Kind& kind);
/// The default in words; "required" or "none" where there is none.
[[nodiscard]] std::string default_of(const Key& key);
/// What the member of a key begins with, as TOML; empty where it is not given at first.
[[nodiscard]] std::string standard_of(const Key& key);
/// Where it has a meaning, "fluids and solids, kind = "solid""; empty: everywhere.
[[nodiscard]] std::string place_of(const Key& key);
/// "only groups with kind = "solid" have it": why a key has no meaning where its `where` does not hold.
[[nodiscard]] std::string refusal(const KeyTable& table, const Where& where);

}  // namespace sph::keys
