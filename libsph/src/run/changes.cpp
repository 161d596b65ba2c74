#include "run/changes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "sph/core/error.hpp"

namespace sph {
namespace {

constexpr auto of_files = std::to_array<std::string_view>(
    {"output.snapshot_interval", "output.series_interval", "output.checkpoint_interval",
     "output.status_interval", "output.sort_limit", "output.compression", "output.checkpoint_files",
     "time.until", "time.steps"});

constexpr std::string_view kept_by_bonds = "terms.bond_reach";  ///< particles have counted them
/// Whole keys, or tables whose keys may all change. What would add fields is refused when these are read.
constexpr auto of_branches = std::to_array<std::string_view>(
    {"title", "time", "output", "monitor", "terms", "domain.gravity", "domain.central_pull", "contact.pair"});
/// Keys of elements: table, key or table in it.
constexpr auto of_elements = std::to_array<std::array<std::string_view, 2>>({{"group", "viscosity"},
                                                                             {"group", "bulk_viscosity"},
                                                                             {"group", "friction"},
                                                                             {"group", "rolling_friction"},
                                                                             {"group", "restitution"},
                                                                             {"group", "permeability"},
                                                                             {"group", "viscosity_law"},
                                                                             {"group", "strength"},
                                                                             {"group", "heat_flux"},
                                                                             {"inlet", "velocity"},
                                                                             {"inlet", "pressure"},
                                                                             {"inlet", "temperature"},
                                                                             {"outlet", "pressure"},
                                                                             {"outlet", "every"},
                                                                             {"insertion", "rate"},
                                                                             {"insertion", "velocity"}});

std::string key_of(const std::string& given) { return given.substr(0, given.find_first_of(" =")); }

bool is_of_files(std::string_view key) {
  return key.starts_with("decomposition.") || std::ranges::find(of_files, key) != of_files.end();
}

bool is_under(std::string_view key, std::string_view table) {
  return key == table || (key.starts_with(table) && key[table.size()] == '.');
}

/// table.NAME.key, or deeper.
bool is_of_element(std::string_view key, const std::array<std::string_view, 2>& allowed) {
  if (!key.starts_with(allowed[0]) || key.size() == allowed[0].size() || key[allowed[0].size()] != '.')
    return false;
  const std::string_view after = key.substr(allowed[0].size() + 1);
  const std::size_t name = after.find('.');
  return name != std::string_view::npos && is_under(after.substr(name + 1), allowed[1]);
}

}  // namespace

void refuse_other_changes(const std::vector<std::string>& overrides) {
  for (const std::string& given : overrides)
    if (const std::string key = key_of(given); !is_of_files(key))
      throw InputError(fmt::format(
          "--set {}: a run that goes on keeps its {}; change decomposition.*, {}, or begin another "
          "run with its state: --branch DIR",
          given, key, fmt::join(of_files, ", ")));
}

void refuse_changes_of_parts(const std::vector<std::string>& overrides) {
  for (const std::string& given : overrides) {
    const std::string key = key_of(given);
    const bool listed =
        is_of_files(key) ||
        std::ranges::any_of(of_branches, [&](std::string_view t) { return is_under(key, t); }) ||
        std::ranges::any_of(of_elements, [&](const auto& e) { return is_of_element(key, e); });
    if (listed && key != kept_by_bonds && key != "terms") continue;
    std::vector<std::string> elements;
    for (const auto& [table, name] : of_elements) elements.push_back(fmt::format("{}.NAME.{}", table, name));
    throw InputError(
        fmt::format("--set {}: a branch keeps its {}; change decomposition.*, {}, {}, or begin another run "
                    "from a snapshot by "
                    "start.file",
                    given, key, fmt::join(of_branches, ", "), fmt::join(elements, ", ")));
  }
}

bool change_laws(const std::vector<std::string>& overrides) {
  return std::ranges::any_of(overrides, [](const std::string& given) {
    const std::string key = key_of(given);
    return !is_of_files(key) && key != "title" && !is_under(key, "output") && !is_under(key, "monitor");
  });
}

}  // namespace sph
