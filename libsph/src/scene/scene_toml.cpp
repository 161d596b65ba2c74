// From TOML to a resolved Scene: top level, kernel, domain, terms, time, and the checks between tables.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <system_error>

#include "scene/scene_resolve.hpp"

namespace sph {
namespace {

constexpr std::array axis_names{"x", "y", "z"};
constexpr double least_h_over_dx = 0.5;
constexpr double most_h_over_dx = 4;
constexpr int least_periodic_cells = 3;
constexpr double most_spacings = 1e7;
constexpr std::uintmax_t largest_scene_bytes = std::uintmax_t{1} << 22;
constexpr double diameters_apart = 1.1;  ///< default spacing of grains: they start without touching

/// All tables but the arrays, made first: a misspelt key is reported before anything that is missing.
struct Tables {
  TableReader top, kernel, domain, start, terms, time, decomposition, output, contact;
  explicit Tables(const toml_tree::Node& root)
      : top(root, "", scene_keys::top),
        kernel(top.table("kernel", scene_keys::kernel)),
        domain(top.table("domain", scene_keys::domain)),
        start(top.table("start", scene_keys::start)),
        terms(top.table("terms", scene_keys::terms)),
        time(top.table("time", scene_keys::time)),
        decomposition(top.table("decomposition", scene_keys::decomposition)),
        output(top.table("output", scene_keys::output)),
        contact(top.table("contact", scene_keys::contact)) {
    (void)top.tables("group", scene_keys::group);
    (void)top.tables("monitor", scene_keys::monitor);
    (void)start.tables("region", scene_keys::region);
    (void)start.table("tile", scene_keys::tile);
    (void)contact.tables("pair", scene_keys::contact_pair);
    (void)top.tables("wall", scene_keys::wall);
    for (const TableReader& stage : top.tables("stage", scene_keys::stage))
      (void)stage.tables("wall", scene_keys::stage_wall);
  }
};

void read_pull(const TableReader& table, Scene& scene) {
  scene.central_pull = table.number("central_pull", dimension::rate_squared, Bound::not_negative).value_or(0);
  table.only_if(scene.central_pull > 0, "pull_centre", "give central_pull too");
  scene.pull_centre = table.vector("pull_centre", dimension::length, scene.dim).value_or(Double3{});
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dim); ++a)
    if (scene.central_pull > 0 && scene.periodic[a])
      table.fail("central_pull", fmt::format("would jump across the period in {}", axis_names[a]),
                 "use it in domains without periods");
}

void read_domain(const TableReader& table, Scene& scene) {
  scene.lower = table.required_vector("lower", dimension::length, scene.dim);
  scene.upper = table.required_vector("upper", dimension::length, scene.dim);
  const auto axes = static_cast<std::size_t>(scene.dim);
  for (std::size_t a = 0; a < axes; ++a)
    if (!(scene.lower[a] < scene.upper[a]))
      table.fail("upper", fmt::format("is not above lower in {}", axis_names[a]), "the domain is empty");
  if (const toml_tree::Node* value = table.find("periodic")) {
    const std::string wanted =
        fmt::format("it must be an array of {} true or false (dimension = {})", axes, axes);
    const toml_tree::Array* array = value->array();
    if (array == nullptr) table.fail("periodic", fmt::format("is {}", type_name(*value)), wanted);
    if (array->size() != axes) table.fail("periodic", fmt::format("has {} values", array->size()), wanted);
    for (std::size_t a = 0; a < axes; ++a) {
      const auto* on = std::get_if<bool>(&(*array)[a].value);
      if (on == nullptr) table.fail("periodic", fmt::format("holds {}", type_name((*array)[a])), wanted);
      scene.periodic[a] = *on;
    }
  }
  scene.gravity = table.vector("gravity", dimension::acceleration, scene.dim).value_or(Double3{});
  read_pull(table, scene);
  scene.surface_pressure =
      table.number("surface_pressure", dimension::pressure, Bound::not_negative).value_or(0);
  table.finish();
}

void read_kernel(const TableReader& table, Scene& scene) {
  scene.kernel = table.choice("shape", kernel_words()).value_or(KernelShape::quintic);
  table.not_both("smoothing_length", "h_over_dx");
  const std::optional<double> h = table.number("smoothing_length", dimension::length, Bound::positive);
  const std::optional<double> ratio = table.number("h_over_dx", dimension::none, Bound::positive);
  if (!h && !ratio)
    table.fail_missing("h_over_dx", "give it (1.0 to 1.2 is usual), or smoothing_length in m");
  scene.smoothing_length = h ? *h : *ratio * scene.spacing;
  const double found = h ? *h / scene.spacing : *ratio;
  constexpr double rounding = 1e-12;  // a limit that is given as h/dx must pass when it comes back as h
  if (found < least_h_over_dx * (1 - rounding) || found > most_h_over_dx * (1 + rounding))
    table.fail(h ? "smoothing_length" : "h_over_dx", fmt::format("makes h/dx = {:.6g}", found),
               fmt::format("it must be {} to {} spacings", least_h_over_dx, most_h_over_dx));
}

InterfaceTension read_surface_tension(const TableReader& table, const std::vector<Group>& groups) {
  const std::string_view right = "name two groups of fluid, for example [\"melt\", \"gas\"]";
  InterfaceTension tension;
  const toml_tree::Node* value = table.find("between");
  if (value == nullptr) table.fail_missing("between", right);
  const toml_tree::Array* names = value->array();
  if (names == nullptr || names->size() != 2) table.fail("between", "is no array of two names", right);
  for (std::size_t k = 0; k < 2; ++k) {
    const auto* name = std::get_if<std::string>(&(*names)[k].value);
    if (name == nullptr) table.fail("between", "holds something else than a name", right);
    tension.between[k] = group_of_name(table, "between", *name, groups);
    if (groups[static_cast<std::size_t>(tension.between[k])].kind != GroupKind::fluid)
      table.fail("between", fmt::format("names \"{}\", which is no fluid", *name), right);
  }
  if (tension.between[0] == tension.between[1]) table.fail("between", "names one group twice", right);
  const auto ends = [&](int k) {
    const int fragments = groups[static_cast<std::size_t>(k)].fragments_to;
    return fragments < 0 ? k : fragments;
  };
  if (ends(tension.between[0]) == ends(tension.between[1]))
    table.fail("between", "names groups that fragment into each other or into the same one",
               "fragments stay on the side of what they broke from");
  tension.coefficient = table.required_number("coefficient", dimension::stiffness, Bound::not_negative);
  tension.form = table.choice("form", tension_form_words()).value_or(tension.form);
  for (const Group& g : groups) {
    const int k = static_cast<int>(&g - groups.data());
    const bool on_a_side = std::any_of(tension.between.begin(), tension.between.end(), [&](int of) {
      return k == of || k == groups[static_cast<std::size_t>(of)].fragments_to;
    });
    if (tension.form == TensionForm::jump && g.kind == GroupKind::fluid && !on_a_side)
      table.fail("form", fmt::format("is \"jump\", and \"{}\" is a third fluid", g.name),
                 "where three fluids meet no curvature says the jump: use \"stress\"");
  }
  table.finish();
  return tension;
}

/// What only total-Lagrangian solids have.
void read_bonds(const TableReader& table, Scene& scene) {
  constexpr double most_stretch = 2;  // float rows hold no larger distances
  const bool total = scene.total_lagrangian();
  Terms& terms = scene.terms;
  for (const std::string_view key : {"hourglass", "largest_stretch"})
    table.only_if(total, key, "only scenes of solids with lagrangian = \"total\" have it");
  terms.hourglass = table.number("hourglass", dimension::none, Bound::not_negative).value_or(terms.hourglass);
  if (terms.hourglass > 1)
    table.fail("hourglass", fmt::format("is {}", terms.hourglass), "it is a share of the modulus, at most 1");
  terms.largest_stretch =
      table.number("largest_stretch", dimension::none, Bound::positive).value_or(terms.largest_stretch);
  if (terms.largest_stretch < 1 || terms.largest_stretch > most_stretch)
    table.fail("largest_stretch", fmt::format("is {}", terms.largest_stretch),
               fmt::format("it is a ratio of lengths, 1 to {}", most_stretch));
}

void read_terms(const TableReader& table, Scene& scene) {
  const bool ida = scene.formulation == Formulation::ida, total = scene.total_lagrangian();
  const bool gas = scene.has_eos(EosKind::ideal_gas);
  Terms& terms = scene.terms;
  if (ida || total) terms.density_diffusion = 0;
  read_shock_terms(table, scene);
  terms.density_diffusion = table.number("density_diffusion", dimension::none, Bound::not_negative)
                                .value_or(terms.density_diffusion);
  terms.shifting = table.flag("shifting").value_or(false);
  const bool uniform = std::all_of(scene.groups.begin(), scene.groups.end(), [&](const Group& g) {
    return g.viscosity == scene.groups.front().viscosity;
  });
  terms.viscosity =
      table.choice("viscosity", viscosity_words())
          .value_or(uniform || ida || total || gas ? ViscosityForm::laplacian : ViscosityForm::symmetric);
  terms.pressure_weights =
      table.choice("pressure_weights", pressure_weights_words()).value_or(terms.pressure_weights);
  if (table.has("surface_tension"))
    terms.surface_tension =
        read_surface_tension(table.table("surface_tension", scene_keys::surface_tension), scene.groups);
  terms.implicit_viscosity = table.flag("implicit_viscosity").value_or(false);
  table.only_if(terms.implicit_viscosity, "viscosity_tolerance", "set implicit_viscosity = true too");
  terms.viscosity_tolerance = table.number("viscosity_tolerance", dimension::none, Bound::positive)
                                  .value_or(terms.viscosity_tolerance);
  const double least = scene.precision == Precision::mixed ? 1e-6 : 1e-12;
  if (terms.viscosity_tolerance > 0.1 || terms.viscosity_tolerance < least)
    table.fail("viscosity_tolerance", fmt::format("is {}", terms.viscosity_tolerance),
               fmt::format("it is a share of the forces, {} to 0.1", least));
  if (ida && terms.density_diffusion != 0)
    table.fail("density_diffusion", fmt::format("is {}", terms.density_diffusion),
               "formulation = \"ida\" has none: remove it");
  if (ida && terms.shifting) table.fail("shifting", "is on", "formulation = \"ida\" has none: remove it");
  const bool solid = scene.has_kind(GroupKind::solid);
  for (const std::string_view key :
       {"viscosity", "implicit_viscosity", "pressure_weights", "surface_tension"}) {
    if (ida && table.has(key)) table.fail(key, "is given", "formulation = \"ida\" has none: remove it");
    if (solid && key != "viscosity" && table.has(key))
      table.fail(key, "is given", "it is for scenes without solids: remove it");
  }
  const auto refuse = [&](bool given, std::string_view key) {
    if (total && given)
      table.fail(key, "is of fluids and updated solids", "total-Lagrangian solids have none: remove it");
  };
  refuse(terms.density_diffusion != 0, "density_diffusion");
  refuse(terms.artificial_viscosity != 0, "artificial_viscosity");
  refuse(terms.shifting, "shifting");
  refuse(table.has("viscosity"), "viscosity");
  read_bonds(table, scene);
  read_added_terms(table, scene);
  table.finish();
}

void read_time(const TableReader& table, Scene& scene) {
  table.not_both("dt", "cfl");
  scene.time.dt = table.number("dt", dimension::time, Bound::positive);
  scene.time.cfl = table.number("cfl", dimension::none, Bound::positive).value_or(scene.time.cfl);
  scene.time.until = table.number("until", dimension::time, Bound::not_negative);
  scene.time.steps = table.whole("steps", 0);
  if (!scene.time.until && !scene.time.steps) table.fail_missing("until", "give the end in s, or steps");
  table.finish();
}

/// Rounding of the operator in single precision shows in the momentum: 1e-4 of it at 1e6, 1e-3 at 1e7. Fluid
/// beside a wall that slips would lack the viscosity of what is mirrored there.
void check_implicit_viscosity(const TableReader& terms, const Scene& scene) {
  constexpr double most = 1e5;
  if (!scene.terms.implicit_viscosity) return;
  for (const Group& g : scene.groups)
    if (g.slip)
      terms.fail("implicit_viscosity", fmt::format("is on, and the wall \"{}\" slips", g.name),
                 "it knows walls that do not slip alone");
  if (scene.precision != Precision::mixed) return;
  double diffusivity = 0, sound = 0;
  for (const Group& g : scene.groups) {
    diffusivity = std::max(diffusivity, g.viscosity / g.density);
    sound = std::max(sound, std::sqrt(g.bulk_modulus / g.density));
  }
  const double h = scene.smoothing_length, dt = scene.time.dt.value_or(scene.time.cfl * h / sound);
  if (const double number = diffusivity * dt / (h * h); number > most)
    terms.fail("implicit_viscosity", fmt::format("in mixed precision with nu dt / h^2 = {:.3g}", number),
               fmt::format("set precision = \"double\" above {:.3g}", most));
}

/// Cells are counted in integers of fixed width: a domain beyond all reason would overflow them.
void check_extent(const TableReader& domain, const Scene& scene) {
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dim); ++a)
    if (const double spacings = (scene.upper[a] - scene.lower[a]) / scene.spacing; spacings > most_spacings)
      domain.fail("upper", fmt::format("the domain is {:.1e} spacings long in {}", spacings, axis_names[a]),
                  fmt::format("at most {:.0e} are possible: check the units here and of start.spacing",
                              most_spacings));
}

/// A particle must not meet two images of another, and the halo on either side must be another cell.
void check_periods(const Tables& tables, const Scene& scene) {
  const double cell = scene.list_range() + scene.support() * scene.decomposition.skin;
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dim); ++a) {
    const double length = scene.upper[a] - scene.lower[a];
    if (scene.periodic[a] && length < least_periodic_cells * cell)
      tables.domain.fail("periodic",
                         fmt::format("the period of {} m in {} is shorter than {} cells of {:.6g} m", length,
                                     axis_names[a], least_periodic_cells, cell),
                         fmt::format("lengthen the domain, or reduce {} or decomposition.skin",
                                     scene.of_grains()          ? "the grains"
                                     : scene.largest_growth > 1 ? "kernel.largest_growth, start.spacing"
                                                                : "start.spacing"));
  }
}

void check_file(const TableReader& table, std::string_view key, const std::string& path) {
  if (path.empty()) return;
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

void read_dimension(const TableReader& top, Scene& scene, bool grains) {
  scene.dim = static_cast<int>(top.whole("dimension", 2, 3).value_or(grains ? 3 : 2));
  if (grains && scene.dim != 3) top.fail("dimension", "is 2", "grains are spheres: leave it out or give 3");
}

void read_fluids_and_solids(const Tables& tables, Scene& scene) {
  scene.formulation =
      tables.top.choice("formulation", formulation_words()).value_or(Formulation::conservative);
  scene.precision = tables.top.choice("precision", precision_words()).value_or(Precision::double_);
  read_domain(tables.domain, scene);
  scene.spacing = tables.start.required_number("spacing", dimension::length, Bound::positive);
  check_extent(tables.domain, scene);
  read_kernel(tables.kernel, scene);
  scene.groups = read_groups(tables.top, scene.dim);
  read_growth(tables.kernel, scene);
  tables.kernel.finish();
  const std::vector<TableReader> groups = tables.top.tables("group", scene_keys::group);
  for (std::size_t k = 0; k < groups.size(); ++k)
    if (scene.formulation == Formulation::ida && scene.groups[k].slip)
      groups[k].fail("slip", "is on", "formulation = \"ida\" has none: remove it");
  if (scene.central_pull > 0 && (scene.has_kind(GroupKind::wall) || scene.has_kind(GroupKind::solid)))
    tables.domain.fail("central_pull", "acts on fluids alone, and the scene has walls or solids",
                       "use gravity there");
}

void read_grains(const Tables& tables, Scene& scene) {
  read_domain(tables.domain, scene);
  scene.contact = read_contact_law(tables.contact);
  scene.groups = read_grain_groups(tables.top, scene.contact);
  scene.contact.pairs = read_contact_pairs(tables.contact, scene);
  scene.spacing = tables.start.number("spacing", dimension::length, Bound::positive)
                      .value_or(diameters_apart * scene.support());
  check_extent(tables.domain, scene);
  scene.walls = read_walls(tables.top, scene);
  scene.stages = read_stages(tables.top, scene);
}

/// Bodies start free of stress, in equations of their own.
void check_total_lagrangian(const Tables& tables, const Scene& scene) {
  if (!scene.total_lagrangian()) return;
  if (scene.formulation == Formulation::ida)
    tables.top.fail("formulation", "is \"ida\"", "it has no solids with lagrangian = \"total\"");
  if (scene.surface_pressure > 0)
    tables.domain.fail("surface_pressure", fmt::format("is {}", scene.surface_pressure),
                       "solids with lagrangian = \"total\" start free of stress: remove it");
  if (scene.start.pressure != InitialPressure::zero)
    tables.start.fail("pressure", "is of fluids", "solids with lagrangian = \"total\" start free of stress");
}

Scene resolve(const toml_tree::Node& root, const std::string& file, bool check_files) {
  if (root.table()->empty())
    toml_tree::fail(fmt::format("{}:1:1", file), "scene", "the file is empty", "describe the scene in TOML");
  const Tables tables(root);
  const bool grains = describes_grains(tables.top);
  refuse_foreign_keys({tables.top, tables.domain, tables.start, tables.time, tables.output}, grains);
  Scene scene;
  scene.file = file;
  scene.name = tables.top.text("title").value_or(std::filesystem::path(file).stem().string());
  read_dimension(tables.top, scene, grains);
  if (grains)
    read_grains(tables, scene);
  else
    read_fluids_and_solids(tables, scene);
  scene.start = read_start(tables.start, scene);
  tables.start.finish();
  if (!grains) read_terms(tables.terms, scene);
  read_time(tables.time, scene);
  scene.decomposition = read_decomposition(tables.decomposition, scene);
  scene.output = read_output(tables.top, tables.output, scene);
  fit_growth(tables.kernel, scene, least_periodic_cells);
  check_periods(tables, scene);
  check_total_lagrangian(tables, scene);
  check_ideal_gas(tables.top, tables.domain, tables.start, tables.terms, scene);
  check_implicit_viscosity(tables.terms, scene);
  scene.free_surface = !scene.of_grains() && has_free_surface(scene);
  scene.open = scene.terms.shifting && scene.free_surface;
  if (check_files) {
    check_file(tables.start, "file", scene.start.file);
    check_file(tables.start.table("tile", scene_keys::tile), "file", scene.start.tile.file);
    check_file(tables.decomposition, "replay", scene.decomposition.replay);
  }
  return scene;
}

Scene parse_and_resolve(const std::string& text, const std::string& name,
                        const std::vector<std::string>& overrides, bool check_files) {
  toml_tree::Node root = toml_tree::parse(text, name);
  for (const std::string& option : overrides) toml_tree::apply_override(root, option);
  return resolve(root, name, check_files);
}

}  // namespace

Scene parse_scene(const std::string& text, const std::string& name,
                  const std::vector<std::string>& overrides) {
  return parse_and_resolve(text, name, overrides, false);
}

Scene read_scene(const std::string& path, const std::vector<std::string>& overrides) {
  const auto unreadable = [&](std::string_view what) {
    toml_tree::fail(fmt::format("{}:1:1", path), "scene", what, "give the path of a TOML scene");
  };
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) unreadable("there is no such file");
  if (std::filesystem::is_directory(status)) unreadable("is a directory");
  if (!std::filesystem::is_regular_file(status)) unreadable("is a pipe or a device");
  if (const std::uintmax_t bytes = std::filesystem::file_size(path, error); bytes > largest_scene_bytes)
    unreadable(fmt::format("has {} bytes, and no scene has more than {}", bytes, largest_scene_bytes));
  std::ifstream in(path, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (!in) unreadable("cannot be read");
  return parse_and_resolve(text, path, overrides, true);
}

}  // namespace sph
