// The value that a table gives to one key, decoded: each function checks type, unit, finiteness and range of
// what is written, in SI. Every problem is one line "where: key: what is wrong; what would be right".
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "keys/all_keys.hpp"
#include "keys/toml_tree.hpp"

namespace sph {

using keys::Key;

/// Values quoted in messages stay short.
[[nodiscard]] std::string shown(std::string_view text);

class KeyValue {
 public:
  /// `path` is the key as --set would address it; `scene` as far as it is known.
  KeyValue(const Key& key, const toml_tree::Node& node, std::string path, const Scene& scene)
      : key_(&key), node_(&node), path_(std::move(path)), scene_(&scene) {}

  [[nodiscard]] const toml_tree::Node& node() const { return *node_; }
  [[noreturn]] void fail(std::string_view what, std::string_view right) const;
  /// "is "x"; did you mean "y"?" for a word that is not among the valid ones.
  [[noreturn]] void fail_word(const std::string& word, const std::vector<std::string>& words) const;

  [[nodiscard]] std::string text() const;
  [[nodiscard]] bool flag() const;
  [[nodiscard]] std::int64_t whole() const;
  [[nodiscard]] double number() const;
  /// Of a node inside the value.
  [[nodiscard]] double number_in(const toml_tree::Node& inner, Dimension dim) const;
  [[nodiscard]] Double3 vector(Dimension dim) const;
  [[nodiscard]] std::array<bool, 3> flags() const;
  [[nodiscard]] std::array<std::int64_t, 3> copies() const;
  [[nodiscard]] int choice() const;
  /// Of the group or wall that is named.
  [[nodiscard]] int index() const;
  [[nodiscard]] std::array<int, 2> two_groups() const;
  /// A path: from the file, relative to its folder; from the command line, to the working one.
  [[nodiscard]] std::string file() const;
  [[nodiscard]] const toml_tree::Array& array(std::string_view wanted) const;
  /// Whichever of these the member holds.
  void put(const keys::Value& member) const;

 private:
  template <class T>
  [[nodiscard]] const T& as(std::string_view wanted) const;  ///< refuses another type

  const Key* key_;
  const toml_tree::Node* node_;
  std::string path_;
  const Scene* scene_;
};

}  // namespace sph
