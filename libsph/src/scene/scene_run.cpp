// [decomposition], [output] and [[monitor]]: what changes the speed and the files of a run, never its
// particles.
#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <cstddef>
#include <limits>

#include "scene/scene_resolve.hpp"

namespace sph {
namespace {

constexpr std::array axis_names{"x", "y", "z"};

/// In 3D the two axes across gravity, so that a column of fluid stays on one rank.
std::array<int, 2> default_cut_axes(const Scene& scene) {
  if (scene.dim == 2) return {0, 1};
  int vertical = 2;
  for (int a : {1, 0})
    if (std::fabs(scene.gravity[static_cast<std::size_t>(a)]) >
        std::fabs(scene.gravity[static_cast<std::size_t>(vertical)]))
      vertical = a;
  return vertical == 2 ? std::array{0, 1} : vertical == 1 ? std::array{0, 2} : std::array{1, 2};
}

int read_axis(const TableReader& table, const toml_tree::Node& value, int dim) {
  for (int a = 0; a < dim; ++a) {
    const auto* number = std::get_if<std::int64_t>(&value.value);
    const auto* word = std::get_if<std::string>(&value.value);
    if ((number != nullptr && *number == a) ||
        (word != nullptr && *word == axis_names[static_cast<std::size_t>(a)]))
      return a;
  }
  table.fail("cut_axes", "names an axis that the scene does not have",
             dim == 2 ? R"(the axes are "x" and "y")" : R"(the axes are "x", "y" and "z")");
}

std::array<int, 2> read_cut_axes(const TableReader& table, const Scene& scene) {
  const toml_tree::Node* value = table.find("cut_axes");
  if (value == nullptr) return default_cut_axes(scene);
  const toml_tree::Array* array = value->array();
  if (array == nullptr || array->size() != 2)
    table.fail("cut_axes", "must be an array of two axes", R"(for example ["x", "y"])");
  const std::array<int, 2> axes{read_axis(table, (*array)[0], scene.dim),
                                read_axis(table, (*array)[1], scene.dim)};
  if (axes[0] == axes[1]) table.fail("cut_axes", "names one axis twice", "name two different axes");
  return axes;
}

std::string read_monitor_name(const TableReader& table, MonitorKind kind,
                              const std::vector<Monitor>& earlier) {
  std::string name = table.text("name").value_or("");
  if (!table.has("name"))
    for (const auto& [word, value] : monitor_words())
      if (value == kind) name = word;
  bool good = !name.empty();
  for (char c : name)
    good = good && (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-');
  if (!good) table.fail("name", fmt::format("is \"{}\"", name), "a name is made of letters, digits, _ and -");
  for (const Monitor& other : earlier)
    if (other.name == name)
      table.fail("name", fmt::format("\"{}\" is taken by an earlier monitor", name),
                 "give each its own name");
  return name;
}

Monitor read_monitor(const TableReader& table, const Scene& scene, const std::vector<Monitor>& earlier) {
  const std::optional<MonitorKind> kind = table.choice("kind", monitor_words());
  const bool grains = scene.of_grains();
  if (!kind)
    table.fail_missing("kind",
                       fmt::format("give \"particle\", \"group\", \"energy\"{}",
                                   grains ? ", \"momentum\", \"wall\" or \"contacts\"" : " or \"momentum\""));
  if (!grains && (*kind == MonitorKind::wall || *kind == MonitorKind::contacts))
    table.fail("kind", "is of grains, and the scene has none",
               "give \"particle\", \"group\", \"energy\" or \"momentum\"");
  Monitor monitor;
  monitor.kind = *kind;
  monitor.name = read_monitor_name(table, *kind, earlier);
  const bool particle = *kind == MonitorKind::particle;
  table.only_if(particle, "id", "only kind = \"particle\" has it");
  table.only_if(particle, "nearest_to", "only kind = \"particle\" has it");
  table.only_if(*kind == MonitorKind::group, "group", "only kind = \"group\" has it");
  if (particle) {
    table.not_both("id", "nearest_to");
    if (const auto id = table.whole("id", 0)) monitor.id = static_cast<std::uint64_t>(*id);
    monitor.nearest_to = table.vector("nearest_to", dimension::length, scene.dim);
    if (!monitor.id && !monitor.nearest_to)
      table.fail_missing("nearest_to", "give it, or the id of a particle");
    for (std::size_t a = 0; monitor.nearest_to && a < static_cast<std::size_t>(scene.dim); ++a)
      if ((*monitor.nearest_to)[a] < scene.lower[a] || (*monitor.nearest_to)[a] > scene.upper[a])
        table.fail("nearest_to", fmt::format("lies outside the domain in {}", axis_names[a]),
                   "name a point between domain.lower and domain.upper");
  }
  if (*kind == MonitorKind::group) {
    (void)table.required_text("group");
    monitor.group = read_group_name(table, "group", scene.groups);
  }
  table.only_if(*kind == MonitorKind::wall, "wall", "only kind = \"wall\" has it");
  if (*kind == MonitorKind::wall) monitor.wall = read_wall_name(table, "wall", scene.walls);
  table.finish();
  return monitor;
}

}  // namespace

Decomposition read_decomposition(const TableReader& table, const Scene& scene) {
  constexpr double largest_skin = 2;
  constexpr double skin_of_grains = 0.06;  // they stay where they are: short lists count for more
  Decomposition d;
  d.cut_axes = read_cut_axes(table, scene);
  if (scene.of_grains()) d.skin = skin_of_grains;
  d.skin = table.number("skin", dimension::none, Bound::not_negative).value_or(d.skin);
  if (d.skin > largest_skin)
    table.fail("skin", fmt::format("is {}", d.skin),
               fmt::format("it is a fraction of the {}, at most {}",
                           scene.of_grains() ? "largest diameter" : "kernel's radius", largest_skin));
  d.rebuild_every =
      static_cast<int>(table.whole("rebuild_every", 0, std::numeric_limits<int>::max()).value_or(0));
  d.overlap = table.flag("overlap").value_or(d.overlap);
  d.cuts = table.choice("balance", cut_rule_words()).value_or(d.cuts);
  d.cost = table.choice("cost", cost_words()).value_or(d.cost);
  d.chaos_seed = static_cast<std::uint64_t>(
      table.whole("chaos_seed", 0).value_or(static_cast<std::int64_t>(d.chaos_seed)));
  d.slow_rank =
      static_cast<int>(table.whole("slow_rank", 0, std::numeric_limits<int>::max()).value_or(d.slow_rank));
  d.slowness = table.number("slowness", dimension::none, Bound::positive).value_or(d.slowness);
  if (d.slowness < 1)
    table.fail("slowness", fmt::format("is {}", d.slowness),
               "it multiplies the time of one rank, at least 1");
  d.record = table.file_path("record", scene.file);
  d.replay = table.file_path("replay", scene.file);
  if (d.cuts == CutRule::replay && d.replay.empty())
    table.fail_missing("replay", "balance = \"replay\" needs the file of recorded cuts");
  table.only_if(d.cuts == CutRule::replay, "replay", "set balance = \"replay\" too");
  table.finish();
  return d;
}

OutputControl read_output(const TableReader& top, const TableReader& table, const Scene& scene) {
  constexpr int most_files = 65536;
  OutputControl out;
  const auto interval = [&](std::string_view key, double fallback) {
    return table.number(key, dimension::time, Bound::not_negative).value_or(fallback);
  };
  out.snapshot_interval = interval("snapshot_interval", out.snapshot_interval);
  out.series_interval = interval("series_interval", out.series_interval);
  out.checkpoint_interval = interval("checkpoint_interval", out.checkpoint_interval);
  out.status_interval = interval("status_interval", out.status_interval);
  out.average_time = interval("average_time", out.average_time);
  out.average_space = table.flag("average_space").value_or(out.average_space);
  out.contacts = table.flag("contacts").value_or(out.contacts);
  out.sort_limit = table.whole("sort_limit", 0).value_or(out.sort_limit);
  out.checkpoint_files = static_cast<int>(table.whole("checkpoint_files", 0, most_files).value_or(0));
  table.finish();
  for (const TableReader& m : top.tables("monitor", scene_keys::monitor))
    out.monitors.push_back(read_monitor(m, scene, out.monitors));
  return out;
}

}  // namespace sph
