// The table of keys: what it says is what the reader does, what the references print and what is committed.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

#include "keys/all_keys.hpp"
#include "keys/law_keys.hpp"
#include "keys/reference.hpp"
#include "keys/toml_tree.hpp"
#include "sph/scene/scene.hpp"

namespace {

namespace fs = std::filesystem;
namespace keys = sph::keys;
using sph::toml_tree::Node;

const fs::path tests_dir = PEPERITE_TEST_DIR;

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::vector<fs::path> complete_scenes() {
  std::vector<fs::path> files;
  for (const fs::directory_entry& e : fs::directory_iterator(tests_dir / "every_key"))
    if (e.path().extension() == ".toml") files.push_back(e.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::string full_name(const keys::KeyTable& table, std::string_view key) {
  return std::string(table.name) + (table.name.empty() ? "" : ".") + std::string(key);
}

std::set<std::string> names_of_table() {
  std::set<std::string> names;
  for (const keys::KeyTable* table : keys::all)
    for (const keys::Key& key : keys::keys_of(*table)) names.insert(full_name(*table, key.name));
  return names;
}

/// Calls use(name, path) for each key below `node`: "group.density" and "group.0.density".
template <class Use>
void walk(const Node& node, const std::string& name, const std::string& path, const Use& use) {
  const auto below = [](const std::string& a, const std::string& b) { return a.empty() ? b : a + "." + b; };
  if (const sph::toml_tree::Table* table = node.table())
    for (const sph::toml_tree::Entry& e : *table) {
      use(below(name, e.key), below(path, e.key));
      walk(e.value, below(name, e.key), below(path, e.key), use);
    }
  if (const sph::toml_tree::Array* array = node.array())
    for (std::size_t k = 0; k < array->size(); ++k)
      walk((*array)[k], name, below(path, std::to_string(k)), use);
}

TEST(Keys, CommittedReferencesAreThosePrinted) {
  const fs::path apps = tests_dir.parent_path() / "apps";
  EXPECT_TRUE(text_of(apps / "keys.md") == keys::reference_markdown())
      << "run build/bin/peperite keys --markdown > apps/keys.md";
  EXPECT_TRUE(text_of(apps / "scene.schema.json") == keys::reference_json_schema())
      << "run build/bin/peperite keys --json-schema > apps/scene.schema.json";
}

TEST(Keys, EveryReferenceHasEveryKey) {
  std::istringstream lines(keys::reference_toml());
  std::string toml;
  // A key is commented out by a # without space.
  for (std::string line; std::getline(lines, line);)
    toml += (line.starts_with('#') && !line.starts_with("# ") ? line.substr(1) : line) + '\n';
  std::set<std::string> found;
  walk(sph::toml_tree::parse(toml, "reference"), "", "",
       [&](const std::string& name, const std::string&) { found.insert(name); });
  EXPECT_EQ(found, names_of_table());
  const std::string text = keys::reference_text(), markdown = keys::reference_markdown();
  for (const keys::KeyTable* table : keys::all)
    for (const keys::Key& key : keys::keys_of(*table)) {
      EXPECT_NE(text.find("\n  " + std::string(key.name) + ": "), std::string::npos) << key.name;
      EXPECT_NE(markdown.find("\n| `" + std::string(key.name) + "` | "), std::string::npos) << key.name;
    }
}

TEST(Keys, ScenesOfTestsUseEveryKey) {
  std::set<std::string> used;
  for (const fs::path& file : complete_scenes())
    walk(sph::toml_tree::parse(text_of(file), file.string()), "", "",
         [&](const std::string& name, const std::string&) { used.insert(name); });
  for (const std::string& name : names_of_table())
    EXPECT_TRUE(used.contains(name)) << "no scene of tests/every_key has " << name;
}

// No key is a date. A key of the table that nothing reads would "have no meaning", or pass.
TEST(Keys, EveryKeyIsReadAndItsTypeChecked) {
  std::set<std::string> checked;
  for (const fs::path& file : complete_scenes())
    walk(sph::toml_tree::parse(text_of(file), file.string()), "", "",
         [&](const std::string& name, const std::string& path) {
           try {
             (void)sph::read_scene(file.string(), {path + "=1979-05-27"});
             ADD_FAILURE() << path << " may be a date";
           } catch (const sph::InputError& e) {
             const std::string message = e.what(), last = name.substr(name.rfind('.') + 1);
             EXPECT_TRUE(message.find("." + last + ": ") != std::string::npos ||
                         message.find(": " + last + ": ") != std::string::npos)
                 << path << ": " << message;
             // Of what must be an array, some messages say only that.
             if (message.find("date") != std::string::npos || message.find("array") != std::string::npos)
               checked.insert(name);
           }
         });
  for (const std::string& name : names_of_table())
    if (!checked.contains(name)) ADD_FAILURE() << name << " is not refused as a date";
}

template <class T>
bool fits(const keys::Kind& kind, T at) {
  using sph::Double3;
  const auto is_one_of = [&]<class... Kind>(const Kind&...) {
    return (std::holds_alternative<Kind>(kind) || ...);
  };
  if constexpr (std::is_same_v<T, keys::Enumerator>)
    return is_one_of(keys::Words{}) && std::get<keys::Words>(kind).all().front().of == at.of;
  else if constexpr (std::is_same_v<T, double*> || std::is_same_v<T, std::optional<double>*>)
    return is_one_of(keys::Number{});
  else if constexpr (std::is_same_v<T, Double3*> || std::is_same_v<T, std::optional<Double3>*>)
    return is_one_of(keys::Vector{});
  else if constexpr (std::is_same_v<T, bool*> || std::is_same_v<T, std::optional<bool>*>)
    return is_one_of(keys::Flag{});
  else if constexpr (std::is_same_v<T, std::array<bool, 3>*>)
    return is_one_of(keys::Flags{});
  else if constexpr (std::is_same_v<T, std::array<int, 2>*>)
    return is_one_of(keys::TwoGroups{});
  else if constexpr (std::is_same_v<T, std::array<std::int64_t, 3>*>)
    return is_one_of(keys::Copies{});
  else if constexpr (std::is_same_v<T, std::string*>)
    return is_one_of(keys::Text{}, keys::File{});
  else if constexpr (std::is_same_v<T, keys::Named>)
    return is_one_of(keys::NameOf{});
  else
    return is_one_of(keys::Whole{});
}

TEST(Keys, MembersAreOfTheirKind) {
  for (const keys::KeyTable* table : keys::all)
    for (const keys::Key& key : table->keys) {
      if (key.member.in == nullptr) continue;
      EXPECT_TRUE(std::visit([&](const auto& at) { return fits(key.kind, at); }, key.member.standard()))
          << full_name(*table, key.name);
    }
}

TEST(Keys, RangesAreWords) {
  using keys::Range;
  EXPECT_EQ(keys::text_of(keys::any), "");
  EXPECT_EQ(keys::text_of(keys::positive), "positive");
  EXPECT_EQ(keys::text_of(keys::not_negative), "not negative");
  EXPECT_EQ(keys::text_of(Range{.least = 1, .most = 2}), "1 to 2");
  EXPECT_EQ(keys::text_of(Range{.least = 1, .above_least = true}), "above 1");
  EXPECT_EQ(keys::text_of(Range{.least = 1}), "at least 1");
  EXPECT_EQ(keys::text_of(Range{.least = 0, .most = 0.5, .below_most = true}), "at least 0 and below 0.5");
  EXPECT_EQ(keys::wanted(keys::up_to(1, "it is a share,"), 2), "it is a share, 0 to 1");
  EXPECT_EQ(keys::wanted(keys::up_to(1, "it is a share,"), -2), "it must not be negative");
  EXPECT_EQ(keys::wanted(keys::positive, 0), "it must be positive");
  EXPECT_FALSE(keys::any.holds(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_FALSE(keys::positive.holds(0));
  EXPECT_TRUE(keys::not_negative.holds(0));
}

}  // namespace
