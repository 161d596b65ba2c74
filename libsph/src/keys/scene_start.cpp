// [start]: the lattice and its painted regions, or a particle file; initial velocity and pressure.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>

#include "core/nearest.hpp"
#include "files/mesh_file.hpp"
#include "keys/scene_resolve.hpp"
#include "scene/mesh_volume.hpp"

namespace sph {
namespace {

constexpr std::array axis_names{"x", "y", "z"};
constexpr double most_lattice_points = 1e12;
constexpr double farthest_origin = 1e9;  ///< [spacings]: the lattice's places are rounded by it

bool can_move(const Group& group) { return group.kind != GroupKind::wall && !group.grain.fixed; }

/// The box around a region, along x, y, z.
std::array<std::array<double, 2>, 3> extent_of(const Region& r) {
  std::array<std::array<double, 2>, 3> out{};
  for (const auto& point : r.points)
    for (std::size_t a = 0; a < 2; ++a)
      out[a] = &point == r.points.data()
                   ? std::array{point[a], point[a]}
                   : std::array{std::min(out[a][0], point[a]), std::max(out[a][1], point[a])};
  if (r.shape == RegionShape::mesh && r.mesh.volume != nullptr)
    for (std::size_t a = 0; a < 3; ++a) out[a] = {r.mesh.volume->lower()[a], r.mesh.volume->upper()[a]};
  if (r.shape == RegionShape::polygon || r.shape == RegionShape::mesh) return out;
  for (std::size_t a = 0; a < 3; ++a) {
    const double widest = std::max(r.radius, r.shape == RegionShape::cone ? r.top_radius : 0.0);
    const double aside = r.from[a] == r.to[a] ? widest : 0;
    out[a] = r.shape == RegionShape::box ? std::array{r.lower[a], r.upper[a]}
             : r.shape == RegionShape::ball
                 ? std::array{r.centre[a] - r.radius, r.centre[a] + r.radius}
                 : std::array{std::min(r.from[a], r.to[a]) - aside, std::max(r.from[a], r.to[a]) + aside};
  }
  return out;
}

void check_place(const Reader<keys::region>& table, const Region& region, const Scene& scene) {
  const LatticeFill& lattice = scene.start.lattice;
  if (region.shape == RegionShape::everywhere) return;
  if (region.shape == RegionShape::mesh && region.mesh.volume == nullptr) return;
  const bool pointed = region.shape == RegionShape::cone && region.top_radius > 0;
  const bool round = region.shape == RegionShape::ball || region.shape == RegionShape::cylinder ||
                     region.shape == RegionShape::cone;
  if (round && !pointed && !(region.radius > 0)) table.fail("radius", "is 0", "it must be positive");
  if (region.shape == RegionShape::cylinder || region.shape == RegionShape::cone) {
    int along = 0;
    for (std::size_t a = 0; a < 3; ++a) along += region.from[a] != region.to[a] ? 1 : 0;
    if (along == 0) table.fail("to", "is the place of `from`", "the axis has no length");
    if (along > 1)
      table.fail("to", "makes the axis oblique", "it must differ from `from` in one coordinate alone");
  }
  bool outside = false;
  const auto extent = extent_of(region);
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dim); ++a) {
    if (region.shape == RegionShape::box && !(region.lower[a] < region.upper[a]))
      table.fail("upper", fmt::format("is not above lower in {}", axis_names[a]), "the box is empty");
    outside = outside || extent[a][1] <= lattice.lower[a] || extent[a][0] >= lattice.upper[a];
  }
  if (outside)
    table.fail("shape", "lies outside the filled lattice", "move it between start.lower and start.upper");
}

void read_points(const Reader<keys::region>& table, const Scene& scene, Region& region) {
  if (scene.dim != 2) table.fail("shape", "is \"polygon\", which exists in 2D only", "use \"mesh\"");
  const std::optional<KeyValue> value = table.value("points");
  if (!value) table.fail_missing("points", "give [[x, y], ...]");
  const toml_tree::Array* points = value->node().array();
  if (points == nullptr || points->size() < 3)
    value->fail("is no polygon", "give an array of three corners or more, [[x, y], ...]");
  for (const toml_tree::Node& point : *points) {
    const toml_tree::Array* pair = point.array();
    if (pair == nullptr || pair->size() != 2)
      value->fail("has a corner that is no pair", "give [[x, y], ...]");
    region.points.push_back(
        {value->number_in((*pair)[0], dimension::length), value->number_in((*pair)[1], dimension::length)});
  }
  const auto& p = region.points;
  const auto on_line = [&](const std::array<double, 2>& b, const std::array<double, 2>& c) {
    return (b[0] - p[0][0]) * (c[1] - p[0][1]) == (b[1] - p[0][1]) * (c[0] - p[0][0]);
  };
  const auto other = std::ranges::find_if(p, [&](const auto& b) { return b != p[0]; });
  if (other == p.end() || std::ranges::all_of(p, [&](const auto& c) { return on_line(*other, c); }))
    value->fail("has all its corners on one line", "it would cover nothing");
}

/// Messages of the file's contents as those of the key.
Triangles triangles_of(const Reader<keys::region>& table, const std::string& file) {
  try {
    return read_triangles(file, "");
  } catch (const InputError& error) {
    const std::string text = error.what();  // ": what; what would be right"
    const std::size_t end = text.rfind("; ");
    table.fail("file", fmt::format("\"{}\": {}", file, text.substr(2, end - 2)), text.substr(end + 2));
  }
}

void read_volume(const Reader<keys::region>& table, const Scene& scene, Region& region) {
  if (scene.dim != 3) table.fail("shape", "is \"mesh\", which exists in 3D only", "use \"polygon\"");
  check_file(table, "file", region.mesh.file);
  const std::string content = hash_of_file(region.mesh.file);
  if (!region.mesh.content.empty() && content != region.mesh.content)
    table.fail("file", fmt::format("\"{}\" is another than the run began with", region.mesh.file),
               "restore it, or begin a new run");
  region.mesh.content = content;
  constexpr double most = 1e12;
  Triangles read = triangles_of(table, region.mesh.file);
  for (auto& v : read.vertices)
    for (std::size_t a = 0; a < 3; ++a) {
      v[a] = v[a] * region.mesh.scale + region.mesh.origin[a];
      if (!(std::fabs(v[a]) <= most))
        table.fail("scale", fmt::format("takes the mesh to {:.3g} m", v[a]), "check its unit");
    }
  region.mesh.volume = std::make_shared<const MeshVolume>(std::move(read.vertices), std::move(read.corners));
}

Region read_region(const Reader<keys::region>& table, const Scene& scene, MeshFiles meshes) {
  Region region;
  table.read(region);
  if (region.shape == RegionShape::polygon) read_points(table, scene, region);
  if (region.shape == RegionShape::mesh && meshes == MeshFiles::read) read_volume(table, scene, region);
  if (const Group* g = region.group < 0 ? nullptr : &scene.groups[static_cast<std::size_t>(region.group)];
      g != nullptr && g->kind == GroupKind::grain) {
    if (scene.has_grains_in_flow())
      table.fail("group", fmt::format("names \"{}\", which is of grains", g->name),
                 "this lattice is that of the fluid: place grains with [[start.grains]]");
    if (!(g->grain.largest_radius > 0))
      table.fail("group", fmt::format("names \"{}\", a material without diameter", g->name),
                 "give that [[group]] the diameter of its grains");
  }
  check_place(table, region, scene);
  table.finish();
  return region;
}

void check_fill(const StartReader& table, const Scene& scene) {
  const LatticeFill& lattice = scene.start.lattice;
  double points = 1;
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dim); ++a) {
    if (!(lattice.lower[a] < lattice.upper[a]))
      table.fail("upper", fmt::format("is not above lower in {}", axis_names[a]), "nothing would be filled");
    if (lattice.lower[a] < scene.domain.lower[a])
      table.fail("lower", fmt::format("reaches below the domain in {}", axis_names[a]),
                 fmt::format("it must be at least {} there", scene.domain.lower[a]));
    if (lattice.upper[a] > scene.domain.upper[a])
      table.fail("upper", fmt::format("reaches above the domain in {}", axis_names[a]),
                 fmt::format("it must be at most {} there", scene.domain.upper[a]));
    points *= (lattice.upper[a] - lattice.lower[a]) / scene.start.spacing;
    if (const double away = std::fabs(lattice.lower[a] - lattice.origin[a]) / scene.start.spacing;
        !(away <= farthest_origin))
      table.fail("origin", fmt::format("is {:.1e} spacings away in {}", away, axis_names[a]),
                 fmt::format("at most {:.0e} are possible: any cell's corner will do", farthest_origin));
  }
  if (points < 1)
    table.fail("spacing", fmt::format("is {} m, more than the filled extent", scene.start.spacing),
               "reduce it so that particles fit in");
  if (points > most_lattice_points)
    table.fail("spacing", fmt::format("is {} m and would make {:.1e} particles", scene.start.spacing, points),
               "check its unit");
}

/// What a period is a whole number of, in spacings, and how it is called.
struct Cell {
  double length;
  std::string_view name;
  int count;  ///< of these in a cell
};

Cell cell_of(LatticeKind kind, std::size_t axis) {
  if (kind == LatticeKind::fcc) return {fcc_edge, "cells", 1};
  if (kind == LatticeKind::square) return {1, "cells", 1};
  return axis == 0 ? Cell{hexagonal_edge, "columns", 1} : Cell{hexagonal_rows, "rows", 2};
}

/// A filled period must hold whole cells of the lattice, or its seam would be wider or narrower than dx.
void check_seam(const StartReader& table, const Scene& scene) {
  const LatticeFill& lattice = scene.start.lattice;
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dim); ++a) {
    const bool filled =
        lattice.lower[a] == scene.domain.lower[a] && lattice.upper[a] == scene.domain.upper[a];
    if (!scene.domain.periodic[a] || !filled) continue;
    const Cell cell = cell_of(lattice.kind, a);
    const double edge = cell.length * scene.start.spacing;
    const double cells = (scene.domain.upper[a] - scene.domain.lower[a]) / edge;
    if (std::fabs(cells - std::nearbyint(cells)) <= 1e-6 * cells) continue;
    const double whole = std::max(std::nearbyint(cells), 1.0);
    table.fail(
        "spacing",
        fmt::format(
            "{}divides the periodic length in {} into {:.6g} {}",
            table.has("spacing") ? "" : fmt::format("is {:.6g} m by default and ", scene.start.spacing),
            axis_names[a], cell.count * cells, cell.name),
        lattice.kind == LatticeKind::hexagonal ? fmt::format("make that length {:.10g} m, which holds {} {}",
                                                             whole * edge, cell.count * whole, cell.name)
                                               : "choose one that gives a whole number");
  }
}

void read_lattice(const StartReader& table, Scene& scene, MeshFiles meshes) {
  Start& start = scene.start;
  if (start.lattice.kind == LatticeKind::hexagonal && scene.dim != 2)
    table.fail("lattice", "is \"hexagonal\", which exists in 2D only", "use \"square\" or \"fcc\"");
  if (start.lattice.kind == LatticeKind::fcc && scene.dim != 3)
    table.fail("lattice", "is \"fcc\", which exists in 3D only", "use \"square\" or \"hexagonal\"");
  if (!table.has("origin")) start.lattice.origin = start.lattice.lower;
  check_fill(table, scene);
  if (!scene.has_melt()) check_seam(table, scene);  // cells fit, however wide
  const std::vector<Reader<keys::region>> regions = table.tables<keys::region>();
  if (regions.empty()) table.fail_missing("region", "paint groups with [[start.region]], or give start.file");
  bool matter = !scene.domain.openings.insertions.empty();  // of grains, that may come later
  for (const auto& r : regions) {
    start.lattice.regions.push_back(read_region(r, scene, meshes));
    const int group = start.lattice.regions.back().group;
    matter = matter || (group >= 0 && can_move(scene.groups[static_cast<std::size_t>(group)]));
  }
  if (!matter)
    table.fail("region",
               scene.of_grains()  ? "no region paints grains that can move, and no [[insertion]] brings any"
               : scene.has_melt() ? "no region paints a melt"
                                  : "no region paints a fluid or a solid",
               "paint at least one");
}

void read_velocity(const StartReader& table, const Scene& scene, Start& start) {
  const std::optional<KeyValue> value = table.value("velocity");
  if (value && value->node().array() != nullptr) {
    start.velocity.kind = InitialVelocity::uniform;
    start.velocity.uniform = *table.vector("velocity", dimension::speed);
  } else if (value) {
    const auto* word = std::get_if<std::string>(&value->node().value);
    const std::string what =
        word == nullptr ? fmt::format("is {}", type_name(value->node())) : fmt::format("is \"{}\"", *word);
    if (scene.of_grains() && (word == nullptr || *word != "rest"))
      table.fail("velocity", what, "grains start with \"rest\" or an array of speeds");
    if (word == nullptr)
      table.fail("velocity", what, "it must be \"rest\", \"taylor_green\" or an array of speeds");
    if (*word == "taylor_green")
      start.velocity.kind = InitialVelocity::taylor_green;
    else if (*word != "rest")
      value->fail_word(*word, {"rest", "taylor_green"});
  }
  if (start.velocity.kind != InitialVelocity::taylor_green) return;
  for (std::size_t a = 0; a < 2; ++a) {
    const double periods = (scene.domain.upper[a] - scene.domain.lower[a]) / start.velocity.flow_length;
    if (!scene.domain.periodic[a] || !std::isfinite(periods) ||
        std::fabs(periods - std::nearbyint(periods)) > 1e-9 * periods)
      table.fail("velocity",
                 fmt::format("is \"taylor_green\", but {} does not repeat with the flow", axis_names[a]),
                 "make x and y periodic with lengths that are multiples of flow_length");
  }
}

/// surface_height is short for one layer of the first fluid, or of the first solid where there is none.
std::vector<Layer> read_layers(const StartReader& table, const Scene& scene) {
  table.not_both("surface_height", "layer");
  std::vector<Layer> layers;
  for (const auto& t : table.tables<keys::layer>()) {
    Layer layer;
    t.read(layer);
    const GroupKind kind = scene.groups[static_cast<std::size_t>(layer.group)].kind;
    if (kind == GroupKind::wall || kind == GroupKind::grain)
      t.fail("group", kind == GroupKind::wall ? "names a wall" : "names grains",
             "the layers are what lies on top of each other");
    if (!layers.empty() && layer.top >= layers.back().top)
      t.fail("top", fmt::format("is {}, not below that of the layer before", layer.top),
             "give the layers from the surface downwards");
    if (!layers.empty() && layer.pressure > 0)
      t.fail("pressure", fmt::format("is {} Pa under another layer", layer.pressure),
             "it is of the first one: below, the pressure is that of what lies above");
    t.finish();
    layers.push_back(layer);
  }
  if (const std::optional<double> surface_height = table.number("surface_height")) {
    const auto first = [&](GroupKind kind) {
      return std::find_if(scene.groups.begin(), scene.groups.end(),
                          [&](const Group& g) { return g.kind == kind; });
    };
    const auto fluid = first(GroupKind::fluid);
    const auto matter = fluid == scene.groups.end() ? first(GroupKind::solid) : fluid;
    layers.push_back({static_cast<int>(matter - scene.groups.begin()), *surface_height});
  }
  return layers;
}

void read_pressure(const StartReader& table, const Scene& scene, Start& start) {
  start.layers = read_layers(table, scene);
  if (start.pressure == InitialPressure::taylor_green && start.velocity.kind != InitialVelocity::taylor_green)
    table.fail("pressure", "is \"taylor_green\" without that velocity",
               "set velocity = \"taylor_green\" too");
  if (start.pressure != InitialPressure::hydrostatic) {
    for (const auto key : {StartReader::Name<>("layer"), StartReader::Name<>("surface_height")})
      table.only_if(table.has("pressure"), key, "give pressure too: \"hydrostatic\" looks at it");
    return;
  }
  if (start.layers.empty())
    table.fail_missing("surface_height", "give the height where the hydrostatic pressure is zero");
  double weight = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    weight += std::fabs(scene.domain.gravity[a]);
    if (scene.domain.periodic[a] && scene.domain.gravity[a] != 0)
      table.fail("pressure",
                 fmt::format("is \"hydrostatic\", but gravity points along the periodic {}", axis_names[a]),
                 "start from \"zero\" or \"uniform\" where a body force drives the flow");
  }
  if (weight == 0)
    table.fail("pressure", "is \"hydrostatic\" without gravity", "set domain.gravity or start from \"zero\"");
}

}  // namespace

void read_start(const StartReader& table, Scene& scene, MeshFiles meshes) {
  Start& start = scene.start;
  const bool tile = scene.of_grains() && table.has("tile");
  const bool from_file = tile || table.has("file");
  if (tile) {
    const auto inner = table.table<keys::tile>();
    inner.read(start.tile);
    inner.finish();
  }
  if (!from_file) {
    start.lattice.lower = scene.domain.lower;
    start.lattice.upper = scene.domain.upper;
  }
  using Name = StartReader::Name<>;
  for (const Name key :
       {Name("lattice"), Name("origin"), Name("lower"), Name("upper"), Name("region"), Name("jitter")})
    table.only_if(!from_file, key,
                  fmt::format("the particles come from start.{}", table.has("file") ? "file" : "tile"));
  table.read(start);
  table.not_both("file", "tile");
  if (scene.has_melt()) table.only_if(false, "file", "melts start from regions that fill the domain");
  if (scene.is_mixture())
    table.only_if(false, "file", "grains in a fluid start from a lattice and [[start.grains]]");
  table.only_if(table.has("file"), "free_surface", "it is for start.file; of a lattice it is known");
  if (!from_file) read_lattice(table, scene, meshes);
  if (scene.of_grains() && from_file) table.only_if(false, "velocity", "the velocities come from the file");
  read_velocity(table, scene, start);
  if (scene.has_melt()) {
    constexpr std::string_view why = "melts start at rest on their grid";
    table.only_if(start.velocity.kind == InitialVelocity::rest, "velocity", why);
    table.only_if(start.lattice.jitter == 0, "jitter", why);
    table.only_if(start.lattice.kind == LatticeKind::square, "lattice", why);
  }
  if (scene.has_matter()) read_pressure(table, scene, start);
  start.fills = read_fills(table, scene);
  table.finish();
}

}  // namespace sph
