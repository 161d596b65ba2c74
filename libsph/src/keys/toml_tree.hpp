// The TOML document as a small tree of our own: every value knows where it was written, in the file or on the
// command line (--set), so that each message can say so. Keeps the TOML library out of all headers.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace sph::toml_tree {

struct Node;
struct Entry;
using Array = std::vector<Node>;
using Table = std::vector<Entry>;
/// Dates and times: no key of a scene wants one.
struct Date {};

struct Node {
  std::string where;   ///< "file:line:column" or "--set a.b=v"
  std::string folder;  ///< of the file, to which paths in it are relative; of the command line: empty
  std::variant<Date, bool, std::int64_t, double, std::string, Array, Table> value;

  [[nodiscard]] const Table* table() const;
  [[nodiscard]] const Array* array() const;
  [[nodiscard]] const Node* find(std::string_view key) const;  ///< nullptr if absent or not a table
};

struct Entry {
  std::string key;
  std::string where;  ///< of the key; the value knows its own place
  Node value;
};

/// By which an element of an array of tables is addressed: its `name`, empty if it has none.
[[nodiscard]] std::string name_of(const Node& node);

/// "a whole number", "a table", ... for messages.
[[nodiscard]] std::string_view type_name(const Node& node);

/// Throws InputError "file:line:column: syntax: ..." if `text` is not TOML.
[[nodiscard]] Node parse(std::string_view text, const std::string& file);

/// Applies one --set "a.b=v": v is TOML, or plain words that become a string; nothing after = removes the
/// key. Arrays of tables are addressed by index from 0 or by the `name` of an element.
void apply_override(Node& root, const std::string& text);

/// Throws the one line of an InputError, with control characters replaced.
[[noreturn]] void fail(std::string_view where, std::string_view key, std::string_view what,
                       std::string_view right);

}  // namespace sph::toml_tree
