// Typed access to one table of a scene, by the entries of keys/. Unknown keys are refused when the reader is
// made; each getter decodes its key (key_value.hpp) and records that it was read, so that finish() can refuse
// keys which have no meaning where they stand. read() does all that for every key with a member.
#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "keys/all_keys.hpp"
#include "keys/key_value.hpp"
#include "keys/toml_tree.hpp"

namespace sph {

class TableReader {
 public:
  /// `path` is the key of the table as --set would address it, empty for the top level; `scene` as far as it
  /// is known.
  TableReader(const toml_tree::Node& node, std::string path, const keys::KeyTable& keys, const Scene& scene);

  [[nodiscard]] bool has(const Key& key) const { return node_->find(key.name) != nullptr; }
  [[nodiscard]] const toml_tree::Node* find(const Key& key) const;  ///< marks the key as read
  [[nodiscard]] const Key& key(std::string_view name) const { return (*keys_)[name]; }

  /// Blames a key of this table (its value's place, or the table's if it is absent).
  [[noreturn]] void fail(const Key& key, std::string_view what, std::string_view right) const;
  [[noreturn]] void fail_missing(const Key& key, std::string_view right) const;
  /// Refuses the key, if it is there, unless `condition` holds; `reason` says when it has a meaning.
  void only_if(bool condition, const Key& key, std::string_view reason) const;
  /// Refuses two keys that say the same thing.
  void not_both(const Key& a, const Key& b) const;
  void require(const Key& key) const;  ///< refuses the table without it
  void finish() const;                 ///< refuses keys that nothing has read

  /// The value of a key, which counts as read; nothing if it is absent.
  [[nodiscard]] std::optional<KeyValue> value(const Key& key) const;
  /// ... decoded by one of the functions of KeyValue.
  template <auto decode, class... Arguments>
  [[nodiscard]] auto get(const Key& key, Arguments... arguments) const
      -> std::optional<std::invoke_result_t<decltype(decode), const KeyValue&, Arguments...>> {
    const std::optional<KeyValue> given = value(key);
    if (!given) return std::nullopt;
    return ((*given).*decode)(arguments...);
  }

 protected:
  void read(void* owner) const;

  /// The sub-table; if it is absent, an empty one in the place of this table.
  struct Part {
    const toml_tree::Node* node;
    std::string path;
    std::shared_ptr<const toml_tree::Node> stand_in;
  };
  [[nodiscard]] Part part(const keys::KeyTable& inner) const;
  /// The elements of an array of tables; they are addressed by their name where they have one.
  [[nodiscard]] std::vector<Part> parts(const keys::KeyTable& inner) const;

  const Scene* scene_;
  std::shared_ptr<const toml_tree::Node> stand_in_;  ///< for a table that is absent

 private:
  [[nodiscard]] std::string path_of(const Key& key) const;
  [[nodiscard]] bool applies(const Key& key) const;  ///< refuses it where it has no meaning

  const toml_tree::Node* node_;
  std::string path_;
  const keys::KeyTable* keys_;
  mutable std::set<std::string_view> used_;
};

/// The reader of one table of keys/: a key that is not in it, or is of another kind, does not compile.
template <const auto& table_keys>
class Reader : public TableReader {
 public:
  using Owner = typename std::remove_cvref_t<decltype(table_keys)>::Owner;

  /// The name of a key of this table, of one of these kinds if there are any.
  template <class... Kind>
  struct Name {
    const Key& key;
    consteval Name(const char* name) : key(table_keys[name]) {  // NOLINT: as good as the name itself
      if (sizeof...(Kind) > 0 && !(std::holds_alternative<Kind>(key.kind) || ...))
        throw std::logic_error("the key is of another kind");
    }
    operator const Key&() const { return key; }
  };
  template <class E>
  struct WordOf : Name<keys::Words> {
    consteval WordOf(const char* name) : Name<keys::Words>(name) {
      if (!std::get<keys::Words>(this->key.kind).template are_of<E>())
        throw std::logic_error("the words of the key are of another enumeration");
    }
  };

  Reader(const toml_tree::Node& node, std::string path, const Scene& scene,
         std::shared_ptr<const toml_tree::Node> stand_in = nullptr)
      : TableReader(node, std::move(path), table_keys, scene) {
    stand_in_ = std::move(stand_in);
  }

  /// Refuses keys that have no meaning here, asks for those that are required, and reads those with a member.
  /// What a key leaves out keeps what `owner` has.
  void read(Owner& owner) const { TableReader::read(&owner); }

  [[nodiscard]] bool has(Name<> key) const { return TableReader::has(key); }
  [[nodiscard]] const toml_tree::Node* find(Name<> key) const { return TableReader::find(key); }
  [[nodiscard]] std::optional<KeyValue> value(Name<> key) const { return TableReader::value(key); }
  [[noreturn]] void fail(Name<> key, std::string_view what, std::string_view right) const {
    TableReader::fail(key, what, right);
  }
  [[noreturn]] void fail_missing(Name<> key, std::string_view right) const {
    TableReader::fail_missing(key, right);
  }
  void only_if(bool condition, Name<> key, std::string_view reason) const {
    TableReader::only_if(condition, key, reason);
  }
  void not_both(Name<> a, Name<> b) const { TableReader::not_both(a, b); }
  void require(Name<> key) const { TableReader::require(key); }
  [[nodiscard]] std::optional<int> index(Name<keys::NameOf> key) const { return get<&KeyValue::index>(key); }
  [[nodiscard]] std::optional<std::string> text(Name<keys::Text, keys::Words> key) const {
    return get<&KeyValue::text>(key);
  }
  [[nodiscard]] std::optional<bool> flag(Name<keys::Flag> key) const { return get<&KeyValue::flag>(key); }
  [[nodiscard]] std::optional<double> number(Name<keys::Number> key) const {
    return get<&KeyValue::number>(key);
  }
  [[nodiscard]] std::optional<Double3> vector(Name<keys::Vector> key) const {
    return get<&KeyValue::vector>(key, std::get<keys::Vector>(key.key.kind).dim);
  }
  /// A vector where another value may stand too.
  [[nodiscard]] std::optional<Double3> vector(Name<keys::Special> key, Dimension dim) const {
    return get<&KeyValue::vector>(key, dim);
  }
  template <class E>
  [[nodiscard]] std::optional<E> choice(WordOf<E> key) const {
    const std::optional<int> n = get<&KeyValue::choice>(key);
    return n ? std::optional(static_cast<E>(*n)) : std::nullopt;
  }
  template <const auto& inner>
  [[nodiscard]] Reader<inner> table() const {
    Part p = part(inner);
    return {*p.node, std::move(p.path), *scene_, std::move(p.stand_in)};
  }
  template <const auto& inner>
  [[nodiscard]] std::vector<Reader<inner>> tables() const {
    std::vector<Reader<inner>> out;
    for (Part& p : parts(inner)) out.emplace_back(*p.node, std::move(p.path), *scene_);
    return out;
  }
};

}  // namespace sph
