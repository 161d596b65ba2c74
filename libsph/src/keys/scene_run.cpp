// [decomposition], [output] and [[monitor]]: what changes the speed and the files of a run, never its
// particles.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>

#include "keys/scene_resolve.hpp"

namespace sph {
namespace {

constexpr std::array axis_names{"x", "y", "z"};

/// In 3D the two axes across gravity, so that a column of fluid stays on one rank.
std::array<int, 2> default_cut_axes(const Scene& scene) {
  if (scene.dim == 2) return {0, 1};
  int vertical = 2;
  for (int a : {1, 0})
    if (std::fabs(scene.domain.gravity[static_cast<std::size_t>(a)]) >
        std::fabs(scene.domain.gravity[static_cast<std::size_t>(vertical)]))
      vertical = a;
  return vertical == 2 ? std::array{0, 1} : vertical == 1 ? std::array{0, 2} : std::array{1, 2};
}

using DecompositionReader = Reader<keys::decomposition>;
using MonitorReader = Reader<keys::monitor>;

int read_axis(const DecompositionReader& table, const toml_tree::Node& value, int dim) {
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

std::array<int, 2> read_cut_axes(const DecompositionReader& table, const Scene& scene) {
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

void check_monitor_name(const MonitorReader& table, const std::string& name,
                        const std::vector<Monitor>& earlier) {
  bool good = !name.empty();
  for (char c : name)
    good = good && (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-');
  if (!good) table.fail("name", fmt::format("is \"{}\"", name), "a name is made of letters, digits, _ and -");
  for (const Monitor& other : earlier)
    if (other.name == name)
      table.fail("name", fmt::format("\"{}\" is taken by an earlier monitor", name),
                 "give each its own name");
}

void check_inside(const MonitorReader& table, MonitorReader::Name<> key, const std::optional<Double3>& point,
                  const Scene& scene) {
  for (std::size_t a = 0; point && a < static_cast<std::size_t>(scene.dim); ++a)
    if ((*point)[a] < scene.domain.lower[a] || (*point)[a] > scene.domain.upper[a])
      table.fail(key, fmt::format("lies outside the domain in {}", axis_names[a]),
                 "name a point between domain.lower and domain.upper");
}

void check_kind(const MonitorReader& table, MonitorKind kind, const Scene& scene) {
  const bool grains = scene.has_grains();
  if (!grains && (kind == MonitorKind::wall || kind == MonitorKind::contacts))
    table.fail("kind", "is of grains, and the scene has none",
               "give \"particle\", \"group\", \"energy\" or \"momentum\"");
  if (kind == MonitorKind::body && !has_rigid_bodies(scene))
    table.fail("kind", "is of rigid bodies, and the scene has none",
               "give a [[group]] of kind = \"solid\" rigid = true, or another monitor");
  if (kind == MonitorKind::melt && !scene.has_melt())
    table.fail("kind", "is of melts, and the scene has none", "give another");
  if (scene.has_melt() && !grains && kind != MonitorKind::melt && kind != MonitorKind::particle)
    table.fail("kind", "is not of melts", "give \"melt\", or \"particle\" for a cell");
  if (kind == MonitorKind::budget && !scene.has_exchange() && scene.domain.resets.empty() &&
      !has_failure(scene) && !scene.domain.openings.any())
    table.fail("kind",
               "is of what particles exchange, and the scene has no heat, gas flow, diffusion, inlet, "
               "insertion or outlet",
               "give another, group.heat, group.permeability or group.water_diffusivity");
  if ((kind == MonitorKind::gauge || kind == MonitorKind::level) && !scene.has_kind(GroupKind::fluid))
    table.fail("kind", "is of fluids, and the scene has none", "give another");
  if (kind == MonitorKind::level && scene.domain.gravity == Double3{})
    table.fail("kind", "is measured against gravity, and there is none",
               "set domain.gravity, or give another");
}

Monitor read_monitor(const MonitorReader& table, const Scene& scene, const std::vector<Monitor>& earlier) {
  const std::optional<MonitorKind> kind = table.choice<MonitorKind>("kind");
  const bool grains = scene.has_grains();
  if (!kind)
    table.fail_missing("kind",
                       fmt::format("give \"particle\", \"group\", \"energy\"{}",
                                   grains ? ", \"momentum\", \"wall\" or \"contacts\"" : " or \"momentum\""));
  check_kind(table, *kind, scene);
  Monitor monitor;
  table.read(monitor);
  if (!table.has("name")) monitor.name = *table.text("kind");
  check_monitor_name(table, monitor.name, earlier);
  if (*kind == MonitorKind::body && !is_rigid(scene.groups[static_cast<std::size_t>(monitor.group)]))
    table.fail("group",
               fmt::format("names \"{}\"", scene.groups[static_cast<std::size_t>(monitor.group)].name),
               "it must name a rigid solid");
  if (*kind == MonitorKind::gauge || *kind == MonitorKind::level) {
    table.only_if(monitor.to.has_value(), "points", "give `to`, where their line ends, too");
    check_inside(table, "at", monitor.at, scene);
    check_inside(table, "to", monitor.to, scene);
  }
  if (*kind == MonitorKind::flux) {
    check_inside(table, "lower", monitor.lower, scene);
    check_inside(table, "upper", monitor.upper, scene);
    if (normal_of(*monitor.lower, *monitor.upper, scene.dim) == static_cast<std::size_t>(scene.dim))
      table.fail("upper", "spans no rectangle with `lower`",
                 "they must be the same along exactly one axis, the one that it is normal to");
  }
  if (*kind == MonitorKind::particle) {
    table.not_both("id", "nearest_to");
    if (!monitor.id && !monitor.nearest_to)
      table.fail_missing("nearest_to", "give it, or the id of a particle");
    check_inside(table, "nearest_to", monitor.nearest_to, scene);
  }
  table.finish();
  return monitor;
}

// Where neighbours look how far they have gone apart, short lists last long enough; with others the fastest particle of all
// decides. Sand that moves wants wide ones, and pairs that cannot touch yet cost it little; but small grains beside large
// ones have many.
double usual_skin(const Scene& scene) {
  if (scene.of_grains()) {
    double least = scene.largest_diameter();
    for (const Group& g : scene.groups)
      if (g.grain.largest_radius > 0) least = std::min(least, 2 * g.grain.least_radius);
    return std::max(0.2, 0.15 * (1 + least / scene.largest_diameter()));
  }
  const bool look = scene.has_matter() && !scene.has_grains() && !has_eos(scene, EosKind::ideal_gas);
  return look ? 0.1 : 0.2;
}

}  // namespace

Decomposition read_decomposition(const DecompositionReader& table, const Scene& scene) {
  Decomposition d;
  d.cut_axes = read_cut_axes(table, scene);
  d.skin = usual_skin(scene);
  table.read(d);
  if (d.cuts == CutRule::replay && d.replay.empty())
    table.fail_missing("replay", "balance = \"replay\" needs the file of recorded cuts");
  table.only_if(d.cuts == CutRule::replay, "replay", "set balance = \"replay\" too");
  table.finish();
  return d;
}

OutputControl read_output(const TopReader& top, const Reader<keys::output>& table, const Scene& scene) {
  OutputControl out;
  table.read(out);
  table.finish();
  for (const MonitorReader& m : top.tables<keys::monitor>())
    out.monitors.push_back(read_monitor(m, scene, out.monitors));
  return out;
}

}  // namespace sph
