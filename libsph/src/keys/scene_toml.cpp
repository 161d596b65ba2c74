// From TOML to a resolved Scene: top level, kernel, time, and the checks between tables.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <optional>
#include <system_error>
#include <utility>

#include "keys/include.hpp"
#include "keys/scene_resolve.hpp"
#include "scene/record.hpp"

namespace sph {
namespace {

constexpr std::array axis_names{"x", "y", "z"};
constexpr double least_h_over_dx = 0.5;
constexpr double rounding = 1e-12;  // a limit that is given as h/dx must pass when it comes back as h
constexpr double most_h_over_dx = 4;
constexpr int least_periodic_cells = 3;
constexpr double most_spacings = 1e7;
constexpr double diameters_apart = 1.1;  ///< default spacing of grains: they start without touching

/// All tables but the arrays, made first: a misspelt key is reported before anything that is missing.
struct Tables {
  TopReader top;
  KernelReader kernel;
  DomainReader domain;
  StartReader start;
  TermsReader terms;
  Reader<keys::time> time;
  Reader<keys::decomposition> decomposition;
  Reader<keys::output> output;
  Reader<keys::contact> contact;
  Reader<keys::drag> drag;
  Tables(const toml_tree::Node& root, const Scene& scene)
      : top(root, "", scene),
        kernel(top.table<keys::kernel>()),
        domain(top.table<keys::domain>()),
        start(top.table<keys::start>()),
        terms(top.table<keys::terms>()),
        time(top.table<keys::time>()),
        decomposition(top.table<keys::decomposition>()),
        output(top.table<keys::output>()),
        contact(top.table<keys::contact>()),
        drag(top.table<keys::drag>()) {
    (void)top.tables<keys::group>();
    (void)top.tables<keys::monitor>();
    (void)start.tables<keys::region>();
    (void)start.table<keys::tile>();
    (void)start.tables<keys::fill>();
    (void)contact.tables<keys::contact_pair>();
    (void)top.table<keys::melt_table>().tables<keys::melt_side>();
    (void)top.tables<keys::wall>();
    (void)top.tables<keys::mesh>();
    (void)top.tables<keys::reset>();
    (void)top.tables<keys::inlet>();
    (void)top.tables<keys::outlet>();
    for (const auto& stage : top.tables<keys::stage>()) (void)stage.tables<keys::stage_wall>();
  }
};

void read_kernel(const KernelReader& table, Scene& scene) {
  table.not_both("smoothing_length", "h_over_dx");
  set_growth(scene);
  table.read(scene.kernel);
  const std::optional<double> ratio = table.number("h_over_dx");
  const bool has_h = table.has("smoothing_length");
  if (!has_h && !ratio)
    table.fail_missing("h_over_dx", "give it (1.0 to 1.2 is usual), or smoothing_length in m");
  if (!has_h) scene.kernel.smoothing_length = *ratio * scene.start.spacing;
  const double found = has_h ? scene.kernel.smoothing_length / scene.start.spacing : *ratio;
  if (found < least_h_over_dx * (1 - rounding) || found > most_h_over_dx * (1 + rounding)) {
    const std::string what = fmt::format("makes h/dx = {:.6g}", found);
    const std::string right = fmt::format("it must be {} to {} spacings", least_h_over_dx, most_h_over_dx);
    if (has_h) table.fail("smoothing_length", what, right);
    table.fail("h_over_dx", what, right);
  }
  table.finish();
}

/// The support ends before the nearest neighbours of these lattices: no particle would meet another.
void check_neighbours(const KernelReader& table, const Scene& scene) {
  const LatticeKind kind = scene.start.lattice.kind;
  const double nearest = kind == LatticeKind::fcc         ? fcc_edge / std::sqrt(2.0)
                         : kind == LatticeKind::hexagonal ? hexagonal_edge
                                                          : 1;
  const double reach = scene.kernel_radius() / scene.start.spacing;
  if (reach > nearest * (1 + rounding)) return;
  const std::string what =
      fmt::format("lets the kernel reach {:.6g} spacings, and neighbours are {:.6g} apart", reach, nearest);
  const double least = nearest / reach * scene.kernel.smoothing_length;
  if (table.has("smoothing_length"))
    table.fail("smoothing_length", what, fmt::format("it must be above {:.6g} m", least));
  table.fail("h_over_dx", what, fmt::format("it must be above {:.6g}", least / scene.start.spacing));
}

void read_time(const Reader<keys::time>& table, const End& end, Scene& scene) {
  table.read(scene.time);
  table.not_both("dt", "cfl");
  if (end.until || end.steps) {
    scene.time.until = end.until;
    scene.time.steps = end.steps;
  }
  if (!scene.time.until && !scene.time.steps) table.fail_missing("until", "give the end in s, or steps");
  table.finish();
}

/// Cells are counted in integers of fixed width: a domain beyond all reason would overflow them.
void check_extent(const DomainReader& domain, const Scene& scene) {
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dim); ++a)
    if (const double spacings = (scene.domain.upper[a] - scene.domain.lower[a]) / scene.start.spacing;
        spacings > most_spacings)
      domain.fail("upper", fmt::format("the domain is {:.1e} spacings long in {}", spacings, axis_names[a]),
                  fmt::format("at most {:.0e} are possible: check the units here and of start.spacing",
                              most_spacings));
}

/// A particle must not meet two images of another, and the halo on either side must be another cell.
void check_periods(const Tables& tables, const Scene& scene) {
  const double cell = scene.list_range() + scene.support() * scene.decomposition.skin;
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dim); ++a) {
    const double length = scene.domain.upper[a] - scene.domain.lower[a];
    if (scene.domain.periodic[a] && length < least_periodic_cells * cell)
      tables.domain.fail(
          "periodic",
          fmt::format("the period of {} m in {} is shorter than {} cells of {:.6g} m", length, axis_names[a],
                      least_periodic_cells, cell),
          fmt::format("lengthen the domain, or reduce {} or decomposition.skin",
                      scene.of_grains()                 ? "the grains"
                      : scene.kernel.largest_growth > 1 ? "kernel.largest_growth, start.spacing"
                                                        : "start.spacing"));
  }
}

void read_top(const TopReader& top, Scene& scene) {
  scene.groups = read_group_names(top);
  scene.dim = scene.has_grains() ? 3 : 2;
  top.read(scene);
  if (scene.has_grains() && scene.dim != 3)
    top.fail("dimension", "is 2", "grains are spheres: leave it out or give 3");
}

void read_fluids_and_solids(const Tables& tables, Scene& scene) {
  tables.start.require("spacing");
  scene.start.spacing = *tables.start.number("spacing");
  check_extent(tables.domain, scene);
  read_groups(tables.top, scene);
  read_resets(tables.top, scene);
  read_kernel(tables.kernel, scene);
  const std::vector<GroupReader> groups = tables.top.tables<keys::group>();
  for (std::size_t k = 0; k < groups.size(); ++k)
    if (scene.terms.formulation == Formulation::ida && scene.groups[k].wall.slip)
      groups[k].fail("slip", "is on", "formulation = \"ida\" has none: remove it");
  if (scene.domain.central_pull > 0 && (scene.has_kind(GroupKind::wall) || scene.has_kind(GroupKind::solid)))
    tables.domain.fail("central_pull", "acts on fluids alone, and the scene has walls or solids",
                       "use gravity there");
}

void read_grains(const Tables& tables, Scene& scene) {
  read_contact_law(tables.contact, scene);
  if (scene.has_melt()) scene.grains.contact.rolling_damping = 0;
  read_grain_groups(tables.top, scene);
  scene.grains.contact.pairs = read_contact_pairs(tables.contact);
  if (scene.of_grains()) {
    scene.start.spacing = tables.start.number("spacing").value_or(diameters_apart * scene.support());
    check_extent(tables.domain, scene);
  }
  scene.grains.walls = read_walls(tables.top, scene);
  scene.grains.meshes = read_meshes(tables.top, scene);
  scene.grains.stages = read_stages(tables.top, scene);
  if (scene.of_grains()) read_openings(tables.top, tables.domain, scene);
}

/// Bodies start free of stress, but for the pressure of a fluid that they are in.
void check_total_lagrangian(const Tables& tables, const Scene& scene) {
  if (!scene.total_lagrangian()) return;
  if (scene.terms.formulation == Formulation::ida)
    tables.top.fail("formulation", "is \"ida\"", "it has no solids with lagrangian = \"total\"");
  if (tables.terms.has("bond_reach") &&
      *scene.terms.bonds.reach * scene.start.spacing > scene.kernel_radius() * (1 + 1e-12))
    tables.terms.fail("bond_reach", fmt::format("is {}", *scene.terms.bonds.reach),
                      fmt::format("bonds reach as far as the kernel at most, {:.4g} spacings",
                                  scene.kernel_radius() / scene.start.spacing));
  const std::vector<GroupReader> groups = tables.top.tables<keys::group>();
  for (std::size_t k = 0; k < groups.size(); ++k)
    for (const Transition& row : scene.groups[k].becomes)
      if (row.of_failure() && row.keeps == Conserved::both && scene.start.pressure != InitialPressure::zero)
        groups[k].tables<keys::becomes>()[0].fail("keeps", "is \"both\" where start.pressure is not \"zero\"",
                                                  "what bears a pressure at the start has no mass for it "
                                                  "that melt could have: give keeps = \"volume\"");
  if (has_dry_bodies(scene) && scene.domain.surface_pressure > 0)
    tables.domain.fail("surface_pressure", fmt::format("is {}", scene.domain.surface_pressure),
                       "solids with lagrangian = \"total\" start free of stress: remove it");
  if (has_dry_bodies(scene) && scene.start.pressure != InitialPressure::zero)
    tables.start.fail("pressure", "is of fluids", "solids with lagrangian = \"total\" start free of stress");
}

Scene resolve(const toml_tree::Node& root, const std::string& file, const End& end, bool check_files,
              MeshFiles meshes = MeshFiles::read) {
  if (root.table()->empty())
    toml_tree::fail(fmt::format("{}:1:1", file), "scene", "the file is empty", "describe the scene in TOML");
  Scene scene;
  scene.file = file;
  scene.name = std::filesystem::path(file).stem().string();
  const Tables tables(root, scene);
  read_top(tables.top, scene);
  read_domain(tables.domain, scene);
  if (scene.has_matter()) read_fluids_and_solids(tables, scene);
  if (scene.has_grains()) read_grains(tables, scene);
  if (scene.has_melt()) {
    read_melt(tables.top, tables.domain, tables.start, scene);
    check_extent(tables.domain, scene);
  }
  if (scene.has_grains_in_flow()) read_drag(tables.top, tables.drag, scene);
  read_start(tables.start, scene, meshes);
  if (scene.has_matter()) check_neighbours(tables.kernel, scene);
  if (scene.has_matter()) read_terms(tables.terms, scene);
  if (scene.has_matter()) read_openings(tables.top, tables.domain, scene);
  read_time(tables.time, end, scene);
  scene.decomposition = read_decomposition(tables.decomposition, scene);
  scene.output = read_output(tables.top, tables.output, scene);
  fit_growth(tables.kernel, scene, least_periodic_cells);
  check_melt_grid(tables.start, scene);
  check_periods(tables, scene);
  if (scene.terms.bonds.reach && !tables.terms.has("bond_reach"))
    scene.terms.bonds.reach = std::min(*scene.terms.bonds.reach, scene.kernel_radius() / scene.start.spacing);
  if (scene.has_kind(GroupKind::solid))
    tables.kernel.only_if(scene.kernel.shape == KernelShape::quintic, "shape",
                          "beside solids the kernel is \"quintic\"");
  check_total_lagrangian(tables, scene);
  check_ideal_gas(tables.top, tables.domain, tables.start, tables.terms, scene);
  check_implicit_viscosity(tables.terms, scene);
  check_still_step(tables.terms, scene);
  if (scene.has_matter()) check_ranges(tables.top, tables.domain, tables.start, tables.terms, scene);
  if (meshes == MeshFiles::read)  // without them nobody knows
    scene.start.has_surface = scene.has_matter() && (has_free_surface(scene) || scene.domain.openings.any());
  check_background(tables.domain, scene);
  if (check_files) {
    check_file(tables.start, "file", scene.start.file);
    check_file(tables.start.table<keys::tile>(), "file", scene.start.tile.file);
    check_file(tables.decomposition, "replay", scene.decomposition.replay);
    find_meshes(tables.top, scene);
  }
  return scene;
}

Scene complete_and_resolve(toml_tree::Node document, const std::string& file,
                           const std::vector<std::string>& overrides, const End& end, bool check_files) {
  toml_tree::Node root = with_includes(std::move(document), file);
  for (const std::string& option : overrides) apply_override(root, option);
  if (const toml_tree::Node* late = root.find("include"))
    toml_tree::fail(late->where, "include", "comes too late: files are included before --set acts",
                    "write it in the scene, as a text or an array of texts");
  return resolve(root, file, end, check_files);
}

}  // namespace

void check_file(const TableReader& table, std::string_view name, const std::string& path) {
  if (path.empty()) return;
  const Key& key = table.key(name);
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (std::filesystem::is_directory(status))
    table.fail(key, fmt::format("\"{}\" is a directory", path), "give a file");
  // A pipe would be opened for ever, a device read for ever.
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    table.fail(key, fmt::format("\"{}\" is a pipe or a device", path), "give a file");
  if (!std::ifstream(path))
    table.fail(key, fmt::format("\"{}\" cannot be read", path), "give an existing file");
}

Scene parse_scene(const std::string& text, const std::string& name, const std::vector<std::string>& overrides,
                  const End& end, bool begins) {
  return complete_and_resolve(toml_tree::parse(text, name), name, overrides, end, begins);
}

Scene parse_record(const std::string& text, const std::string& name) {
  return resolve(toml_tree::parse(text, name), name, {}, false, MeshFiles::leave);
}

Scene read_scene(const std::string& path, const std::vector<std::string>& overrides, const End& end) {
  return complete_and_resolve(toml_tree::read(path), path, overrides, end, true);
}

}  // namespace sph
