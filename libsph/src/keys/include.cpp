#include "keys/include.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

namespace sph::toml_tree {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t largest_bytes = std::uintmax_t{1} << 22;

/// `refuse` says what is wrong with the path, and does not return.
template <class Refuse>
Node read(const std::string& path, Refuse&& refuse) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) refuse("there is no such file");
  if (fs::is_directory(status)) refuse("is a directory");
  if (!fs::is_regular_file(status)) refuse("is a pipe or a device");
  if (const std::uintmax_t bytes = fs::file_size(path, error); bytes > largest_bytes)
    refuse(fmt::format("has {} bytes, and no scene has more than {}", bytes, largest_bytes));
  std::ifstream in(path, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (!in) refuse("cannot be read");
  return parse(text, path);
}

bool of_tables(const Node& node) {
  const Array* array = node.array();
  return array != nullptr && !array->empty() &&
         std::ranges::all_of(*array, [](const Node& element) { return element.table() != nullptr; });
}

void merge(Node& into, Node from, const std::string& path);

void merge_tables(Table& into, Table from, const std::string& path) {
  for (Entry& e : from) {
    const auto at = std::ranges::find(into, e.key, &Entry::key);
    if (at == into.end()) {
      into.push_back(std::move(e));
      continue;
    }
    merge(at->value, std::move(e.value), path.empty() ? e.key : path + "." + e.key);
    at->where = e.where;
  }
}

/// Two elements of one name in one file stay two, which the reader refuses: one of the file before takes one.
void merge_arrays(Array& into, Array from, const std::string& path) {
  const auto before = static_cast<std::ptrdiff_t>(into.size());
  std::vector<std::string> merged;
  for (Node& element : from) {
    const std::string name = name_of(element);
    const auto last = into.begin() + before;
    const auto at = std::find_if(into.begin(), last, [&](const Node& n) { return name_of(n) == name; });
    const bool again = std::ranges::find(merged, name) != merged.end();
    merged.push_back(name);
    if (name.empty() || at == last || again)
      into.push_back(std::move(element));
    else
      merge(*at, std::move(element), path + "." + name);
  }
}

void merge(Node& into, Node from, const std::string& path) {
  if ((into.table() == nullptr) != (from.table() == nullptr))
    fail(from.where, path, fmt::format("is {}, but {} at {}", type_name(from), type_name(into), into.where),
         "write both alike");
  if (from.table() != nullptr) {
    merge_tables(std::get<Table>(into.value), std::move(std::get<Table>(from.value)), path);
    from.value = std::move(into.value);
  } else if (of_tables(into) && of_tables(from)) {
    merge_arrays(std::get<Array>(into.value), std::move(std::get<Array>(from.value)), path);
    from.value = std::move(into.value);
  }
  into = std::move(from);
}

std::optional<Node> take_include(Node& document) {
  Table& table = std::get<Table>(document.value);
  const auto at = std::ranges::find(table, "include", &Entry::key);
  if (at == table.end()) return std::nullopt;
  Node include = std::move(at->value);
  table.erase(at);
  return include;
}

/// Each is of a text.
std::vector<Node> paths_of(Node include) {
  Array paths;
  if (auto* many = std::get_if<Array>(&include.value))
    paths = std::move(*many);
  else
    paths.push_back(std::move(include));
  for (const Node& path : paths)
    if (!std::holds_alternative<std::string>(path.value))
      fail(path.where, "include", fmt::format("is {}", type_name(path)),
           "give the path of a scene, or an array of paths");
  return paths;
}

class Includes {
 public:
  Node expand(Node document, const std::string& file) {
    std::optional<Node> include = take_include(document);
    if (!include) return document;
    std::error_code error;  // what cannot be read is told elsewhere
    around_.push_back(fs::weakly_canonical(file, error));
    seen_.push_back(around_.back());
    Node whole{document.where, document.folder, Table{}};
    for (const Node& path : paths_of(std::move(*include)))
      if (std::optional<Node> more = read_once(path)) merge(whole, std::move(*more), "");
    merge(whole, std::move(document), "");
    around_.pop_back();
    return whole;
  }

 private:
  /// What is included from two places counts at the first; nothing at the second.
  std::optional<Node> read_once(const Node& path) {
    const auto& words = std::get<std::string>(path.value);
    const std::string file = (fs::path(path.folder) / words).string();  // ".." is the system's, beyond links
    const auto refuse = [&](std::string_view what) {
      fail(path.where, "include", fmt::format("\"{}\": {}", words, what),
           "give the path of a scene, relative to this file");
    };
    std::error_code error;
    const fs::path itself = fs::weakly_canonical(file, error);
    if (error) refuse(error.message());
    if (std::ranges::find(around_, itself) != around_.end()) refuse("it includes this file, or is it");
    if (std::ranges::find(seen_, itself) != seen_.end()) return std::nullopt;
    seen_.push_back(itself);
    return expand(read(file, refuse), file);
  }

  std::vector<fs::path> around_, seen_;
};

}  // namespace

Node read(const std::string& path) {
  return read(path, [&](std::string_view what) {
    fail(fmt::format("{}:1:1", path), "scene", what, "give the path of a TOML scene");
  });
}

Node with_includes(Node document, const std::string& file) {
  return Includes().expand(std::move(document), file);
}

}  // namespace sph::toml_tree
