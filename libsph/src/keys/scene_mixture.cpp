// [drag] and [[start.grains]]: grains in a fluid.
#include <fmt/format.h>

#include <cstddef>

#include "keys/scene_resolve.hpp"
#include "scene/grain_fill.hpp"

namespace sph {
namespace {

constexpr std::array axis_names{"x", "y", "z"};
constexpr double most_grains = 1e12;

GrainFill read_fill(const Reader<keys::fill>& table, const Scene& scene) {
  GrainFill fill;
  table.read(fill);
  if (const Group& g = scene.groups[static_cast<std::size_t>(fill.group)]; !(g.grain.largest_radius > 0))
    table.fail("group", fmt::format("names \"{}\", a material without diameter", g.name),
               "give that [[group]] the diameter of its grains");
  for (std::size_t a = 0; a < 3; ++a) {
    if (!(fill.lower[a] < fill.upper[a]))
      table.fail("upper", fmt::format("is not above lower in {}", axis_names[a]), "nothing would be filled");
    if (fill.lower[a] < scene.domain.lower[a] || fill.upper[a] > scene.domain.upper[a])
      table.fail(fill.lower[a] < scene.domain.lower[a] ? Reader<keys::fill>::Name<>("lower")
                                                       : Reader<keys::fill>::Name<>("upper"),
                 fmt::format("reaches out of the domain in {}", axis_names[a]),
                 fmt::format("the domain is {} to {} there", scene.domain.lower[a], scene.domain.upper[a]));
  }
  double grains = 1;
  for (std::size_t a = 0; a < 3; ++a) grains *= (fill.upper[a] - fill.lower[a]) / fill.spacing;
  if (grains > most_grains)
    table.fail("spacing", fmt::format("is {} m and would make {:.1e} grains", fill.spacing, grains),
               "check its unit");
  if (count(fill) == 0)
    table.fail("spacing", fmt::format("is {} m, more than twice the filled extent", fill.spacing),
               "reduce it so that grains fit in");
  table.finish();
  return fill;
}

}  // namespace

void read_drag(const TopReader& top, const Reader<keys::drag>& table, Scene& scene) {
  table.read(scene.grains.drag);
  table.only_if(scene.grains.drag.law->resistance != nullptr, "own_disturbance",
                "with law = \"none\" fluid and grains do not act on each other");
  if (scene.is_suspension() && scene.grains.drag.law->resistance == nullptr)
    table.fail("law", "is \"none\"", "melts drag the grains in them: give another");
  table.finish();
  if (scene.is_suspension()) return;
  if (scene.terms.formulation == Formulation::ida)
    top.fail("formulation", "is \"ida\"", "it knows no grains: use \"conservative\"");
  const std::vector<GroupReader> groups = top.tables<keys::group>();
  for (std::size_t k = 0; k < groups.size(); ++k)
    if (const double d = 2 * scene.groups[k].grain.largest_radius; d > scene.kernel.smoothing_length)
      groups[k].fail(
          "diameter",
          fmt::format("reaches {:.4g} m, more than the smoothing length of {:.4g} m", d,
                      scene.kernel.smoothing_length),
          "the fluid is averaged over the kernel around grains: raise kernel.smoothing_length, at best to "
          "two diameters or more");
  for (std::size_t k = 0; k < groups.size(); ++k)
    if (scene.groups[k].eos.law->kind == EosKind::ideal_gas)
      groups[k].fail("eos", "is \"ideal_gas\" beside grains", "grains act on liquids and bubbly magma alone");
}

std::vector<GrainFill> read_fills(const StartReader& start, const Scene& scene) {
  std::vector<GrainFill> fills;
  for (const auto& table : start.tables<keys::fill>()) fills.push_back(read_fill(table, scene));
  if (fills.empty() && scene.has_grains_in_flow())
    start.fail_missing("grains", "place grains in the fluid with [[start.grains]]");
  return fills;
}

}  // namespace sph
