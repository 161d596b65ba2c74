// Typed access to one table of a scene. Unknown keys are refused when the reader is made; each getter checks
// type, unit, finiteness and range, and records that the key was read, so that finish() can refuse keys which
// have no meaning where they stand. Every problem is one line "where: key: what is wrong; what would be
// right".
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/scene_keys.hpp"
#include "scene/toml_tree.hpp"
#include "scene/units.hpp"

namespace sph {

/// The keys of a table, with those that laws and terms have brought (law_key.hpp, added_term.hpp).
[[nodiscard]] std::vector<std::string> keys_of(const KeyTable& table);

enum class Bound { any, positive, not_negative };

/// The words a key may have and what they stand for.
template <class E>
using Choices = std::vector<std::pair<std::string_view, E>>;

class TableReader {
 public:
  /// `path` is the key of the table as --set would address it, empty for the top level.
  TableReader(const toml_tree::Node& node, std::string path, const KeyTable& keys);

  [[nodiscard]] bool has(std::string_view key) const { return node_->find(key) != nullptr; }
  [[nodiscard]] const toml_tree::Node* find(std::string_view key) const;  ///< marks the key as read
  [[nodiscard]] std::string path_of(std::string_view key) const;

  /// Blames a key of this table (its value's place, or the table's if it is absent).
  [[noreturn]] void fail(std::string_view key, std::string_view what, std::string_view right) const;
  /// Refuses the key, if it is there, unless `condition` holds; `reason` says when it has a meaning.
  void only_if(bool condition, std::string_view key, std::string_view reason) const;
  /// Refuses two keys that say the same thing.
  void not_both(std::string_view a, std::string_view b) const;
  void finish() const;  ///< refuses keys that nothing has read

  [[nodiscard]] std::optional<std::string> text(std::string_view key) const;
  [[nodiscard]] std::optional<bool> flag(std::string_view key) const;
  [[nodiscard]] std::optional<std::int64_t> whole(
      std::string_view key, std::int64_t least,
      std::int64_t most = std::numeric_limits<std::int64_t>::max()) const;
  [[nodiscard]] std::optional<double> number(std::string_view key, Dimension dim, Bound bound) const;
  [[nodiscard]] std::optional<std::array<double, 3>> vector(std::string_view key, Dimension dim,
                                                            int axes) const;
  [[nodiscard]] double required_number(std::string_view key, Dimension dim, Bound bound) const;
  [[nodiscard]] std::array<double, 3> required_vector(std::string_view key, Dimension dim, int axes) const;
  [[nodiscard]] std::string required_text(std::string_view key) const;
  /// A path: from the file, relative to its folder; from the command line, to the working one.
  [[nodiscard]] std::string file_path(std::string_view key, const std::string& scene_file) const;

  template <class E>
  [[nodiscard]] std::optional<E> choice(std::string_view key, const Choices<E>& choices) const {
    const std::optional<std::string> word = text(key);
    if (!word) return std::nullopt;
    std::vector<std::string> words;
    for (const auto& [name, value] : choices) {
      if (name == *word) return value;
      words.emplace_back(name);
    }
    fail_word(key, *word, words);
  }

  /// The sub-table; if it is absent, an empty one in the place of this table.
  [[nodiscard]] TableReader table(std::string_view key, const KeyTable& keys) const;
  /// The elements of an array of tables; they are addressed by their name where they have one.
  [[nodiscard]] std::vector<TableReader> tables(std::string_view key, const KeyTable& keys) const;
  /// "is "x"; did you mean "y"?" for a word that is not among the valid ones.
  [[noreturn]] void fail_word(std::string_view key, const std::string& word,
                              const std::vector<std::string>& words) const;
  [[noreturn]] void fail_missing(std::string_view key, std::string_view right) const;
  /// A node inside the value of `key` as a number in SI.
  [[nodiscard]] double to_number(const toml_tree::Node& value, std::string_view key, Dimension dim) const;

 private:
  const toml_tree::Node* node_;
  std::shared_ptr<const toml_tree::Node> stand_in_;  ///< for a table that is absent
  std::string path_;
  KeyTable keys_;
  mutable std::set<std::string, std::less<>> used_;
};

}  // namespace sph
