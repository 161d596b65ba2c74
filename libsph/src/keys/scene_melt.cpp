// [[group]] with kind = "melt", [melt] and [[melt.side]].
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "keys/scene_resolve.hpp"
#include "scene/painting.hpp"
#include "sph/core/findings.hpp"
#include "sph/scene/melt_grid.hpp"
#include "stokes/multigrid.hpp"

namespace sph {
namespace {

constexpr std::array axis_names{"x", "y", "z"};
constexpr std::size_t most_melts = 2;
constexpr double most_aspect = 1.5;
constexpr double least_edge = 1e-30,
                 most_edge = 1e30;  // [m]: the solver squares viscosities over squares of them
constexpr double least_cells_of_wave = 2;
constexpr int places = 32;  // along each axis, at which a melt must be painted

using MeltReader = Reader<keys::melt_table>;
using SideReader = Reader<keys::melt_side>;

void read_melt_groups(const TopReader& top, Scene& scene) {
  const std::vector<GroupReader> tables = top.tables<keys::group>();
  std::size_t melts = 0;
  for (std::size_t k = 0; k < tables.size(); ++k) {
    Group& group = scene.groups[k];
    if (group.kind != GroupKind::melt) continue;
    if (++melts > most_melts) tables[k].fail("kind", "is a third melt", "there are two at most");
    tables[k].read(group);
    tables[k].require("density");
    tables[k].require("viscosity");
    if (!(group.viscosity > 0))
      tables[k].fail("viscosity", fmt::format("is {}", group.viscosity), "a melt must have some");
    tables[k].finish();
  }
}

/// What has no meaning where nothing has inertia.
void check_grains_in_melt(const TopReader& top, const Scene& scene) {
  const std::vector<GroupReader> groups = top.tables<keys::group>();
  for (std::size_t k = 0; k < groups.size(); ++k) {
    const Group& g = scene.groups[k];
    if (g.grain.fixed) groups[k].fail("fixed", "is true", "grains move with the melt that they are in");
    const double d = 2 * g.grain.largest_radius;
    if (d > scene.start.spacing)
      groups[k].fail(
          "diameter", fmt::format("reaches {:.4g} m, more than a cell of {:.4g} m", d, scene.start.spacing),
          "the grid sees grains averaged over cells: make these wider, at best two diameters or more");
  }
  for (const auto& wall : top.tables<keys::wall>()) {
    constexpr std::string_view why = "walls beside melts stay where they are";
    wall.only_if(wall.vector("velocity").value_or(Double3{}) == Double3{}, "velocity", why);
    wall.only_if(false, "servo_gain", why);
  }
  for (const auto& stage : top.tables<keys::stage>())
    for (const auto& wall : stage.tables<keys::stage_wall>())
      wall.only_if(wall.vector("velocity").value_or(Double3{}) == Double3{}, "velocity",
                   "walls beside melts stay where they are");
}

MeltSide read_side(const SideReader& table, const Scene& scene, const MeltControl& melt) {
  MeltSide side;
  table.read(side);
  const auto axis = static_cast<std::size_t>(side.side) / 2;
  const std::string_view name = axis < 3 ? axis_names[axis] : "";
  if (axis >= static_cast<std::size_t>(scene.dim))
    table.fail("side", fmt::format("is of {}, which a scene in {}D does not have", name, scene.dim),
               "give \"x0\", \"x1\", \"y0\" or \"y1\"");
  if (scene.domain.periodic[axis])
    table.fail("side", fmt::format("is of {}, which is periodic", name), "it has no sides: remove it");
  for (const MeltSide& other : melt.sides)
    if (other.side == side.side) table.fail("side", "is described twice", "one [[melt.side]] is enough");
  table.not_both("temperature", "heat_flux");
  table.only_if(melt.diffusivity > 0, "temperature", "there is no heat: give melt.diffusivity");
  table.only_if(melt.diffusivity > 0, "heat_flux", "there is no heat: give melt.diffusivity");
  table.finish();
  return side;
}

void check_heat(const MeltReader& table, const std::vector<GroupReader>& groups, const Scene& scene) {
  const MeltControl& melt = scene.domain.melt;
  if (melt.diffusivity == 0) {
    constexpr std::string_view why = "there is no heat: give diffusivity";
    table.only_if(melt.expansion == 0, "expansion", why);
    table.only_if(melt.viscosity_fall == 0, "viscosity_fall", why);
    table.only_if(melt.start.profile == MeltProfile::groups, "profile", why);
    for (std::size_t k = 0; k < groups.size(); ++k)
      groups[k].only_if(scene.groups[k].kind != GroupKind::melt, "temperature",
                        "there is no heat: give melt.diffusivity");
  }
  const auto too_warm = [&](double t) { return melt.expansion * (t - melt.reference_temperature) >= 1; };
  bool weightless = false;
  for (const Group& g : scene.groups)
    weightless = weightless || (g.kind == GroupKind::melt && too_warm(g.heat.temperature.value_or(0)));
  for (const MeltSide& s : melt.sides) weightless = weightless || (s.temperature && too_warm(*s.temperature));
  if (weightless && scene.is_suspension())
    table.fail("expansion", fmt::format("is {} 1/K: the warmest melt would weigh nothing", melt.expansion),
               "reduce it, or raise reference_temperature");
  if (melt.start.profile != MeltProfile::conductive) return;
  table.only_if(
      !scene.domain.periodic[static_cast<std::size_t>(scene.dim) - 1], "profile",
      "it is between two sides, and the last axis is periodic: leave it out, or take the period off");
  int given = 0;
  for (const MeltSide& s : melt.sides)
    if (static_cast<int>(s.side) / 2 == scene.dim - 1 && s.temperature) ++given;
  if (given != 2)
    table.fail("profile", "is \"conductive\" without two temperatures",
               fmt::format("give those of the sides {0}0 and {0}1",
                           axis_names[static_cast<std::size_t>(scene.dim) - 1]));
}

/// A wave at the start goes on through periods, and cells see it.
void check_wave(const MeltReader& table, const Scene& scene) {
  const MeltStart& start = scene.domain.melt.start;
  table.only_if(start.wave_height != 0, "wave_length", "it is of wave_height");
  if (start.wave_height == 0) return;
  if (!(start.wave_length > 0)) table.fail_missing("wave_length", "wave_height needs it, in m");
  const stokes::Grid grid = melt_grid(scene);
  for (std::size_t a = 0; a + 1 < static_cast<std::size_t>(scene.dim); ++a) {
    const std::string is = fmt::format("is {:.6g} m", start.wave_length);
    if (start.wave_length < least_cells_of_wave * grid.edge[a])
      table.fail("wave_length",
                 fmt::format("{}, and cells are {:.4g} m wide in {}", is, grid.edge[a], axis_names[a]),
                 fmt::format("give {} cells or more", least_cells_of_wave));
    const double length = scene.domain.upper[a] - scene.domain.lower[a], waves = length / start.wave_length;
    const double whole = std::max(std::nearbyint(waves), 1.0);
    if (scene.domain.periodic[a] && std::fabs(waves - whole) > 1e-6 * whole)
      table.fail("wave_length",
                 fmt::format("{}, of which the period of {:.6g} m in {} has {:.6g}", is, length,
                             axis_names[a], waves),
                 fmt::format("give one that fits, {:.6g} m", length / whole));
  }
}

/// Sets start.spacing to the shortest edge of a cell.
void check_cells(const MeltReader& table, const DomainReader& domain, Scene& scene) {
  const stokes::Grid grid = melt_grid(scene);
  const auto [least, most] = std::minmax_element(grid.edge.begin(), grid.edge.begin() + grid.dim);
  if (*most > most_aspect * *least)
    table.fail("cells", fmt::format("makes cells of {:.4g} m by {:.4g} m", *least, *most),
               fmt::format("at most {} times as long as wide are possible: change the numbers", most_aspect));
  if (*least < least_edge || *most > most_edge)
    domain.fail("upper", fmt::format("makes cells of {:.3g} m", *least < least_edge ? *least : *most),
                fmt::format("{:.0e} to {:.0e} m are possible: check the unit", least_edge, most_edge));
  scene.start.spacing = *least;
  try {
    stokes::check_cells(grid);
  } catch (const InputError& error) {
    const std::string_view text = error.what();
    const std::size_t end = text.find(';');
    table.fail("cells", text.substr(0, end), text.substr(end + 2));
  }
}

/// At places all over the domain: what is left between them is found when cells are filled.
void check_painting(const StartReader& start, const Scene& scene) {
  const Domain& domain = scene.domain;
  const int deep = scene.dim == 3 ? places : 1;
  for (int n = 0; n < places * places * deep; ++n) {
    const std::array<int, 3> k{n % places, n / places % places, n / (places * places)};
    Double3 at{};
    for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dim); ++a)
      at[a] = domain.lower[a] + (k[a] + 0.5) / places * (domain.upper[a] - domain.lower[a]);
    if (painted_group(scene, at) < 0)
      start.fail("region",
                 "paints no melt " + place_text(std::span(at).first(static_cast<std::size_t>(scene.dim))),
                 "begin with one of shape \"everywhere\"");
  }
}

}  // namespace

void read_melt(const TopReader& top, const DomainReader& domain, const StartReader& start, Scene& scene) {
  start.only_if(false, "spacing", "melts have cells: give melt.cells");
  read_melt_groups(top, scene);
  const auto table = top.table<keys::melt_table>();
  table.read(scene.domain.melt);
  for (const auto& side : table.tables<keys::melt_side>())
    scene.domain.melt.sides.push_back(read_side(side, scene, scene.domain.melt));
  check_cells(table, domain, scene);
  check_heat(table, top.tables<keys::group>(), scene);
  check_wave(table, scene);
  if (scene.domain.melt.start.mixture == MeltMixture::linear) {
    table.only_if(melts_of(scene)[0] != melts_of(scene)[1], "mixture", "it is of two melts");
    table.only_if(!scene.domain.periodic[static_cast<std::size_t>(scene.dim) - 1], "mixture",
                  "it grows between two sides, and the last axis is periodic");
  }
  table.finish();
  if (scene.domain.central_pull > 0) domain.only_if(false, "central_pull", "it is of fluids");
  if (scene.has_grains()) check_grains_in_melt(top, scene);
}

void check_melt_grid(const StartReader& start, const Scene& scene) {
  if (!scene.has_melt()) return;
  const LatticeFill& lattice = scene.start.lattice;
  using Name = StartReader::Name<>;
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dim); ++a)
    if (lattice.lower[a] != scene.domain.lower[a] || lattice.upper[a] != scene.domain.upper[a] ||
        lattice.origin[a] != scene.domain.lower[a])
      start.fail(lattice.upper[a] != scene.domain.upper[a] ? Name("upper") : Name("lower"),
                 fmt::format("leaves cells of the domain out in {}", axis_names[a]),
                 "melts fill it: remove the key");
  check_painting(start, scene);
}

}  // namespace sph
