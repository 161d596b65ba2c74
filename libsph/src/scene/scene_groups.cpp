// [[group]]: materials, with what each kind needs and what it must not have.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <optional>

#include "scene/nearest.hpp"
#include "scene/scene_resolve.hpp"
#include "sph/eos/law.hpp"

namespace sph {
namespace {

/// Elastic constants: K from the sound speed, mu from Poisson's ratio, as the paper's readers know them.
void read_stiffness(const TableReader& table, Group& group, const Group* like) {
  if (group.eos->kind == EosKind::ideal_gas) return read_ideal_gas(table, group);
  for (const std::string_view key : {"heat_ratio", "start_pressure"})
    table.only_if(false, key, "only groups with eos = \"ideal_gas\" have it");
  table.not_both("bulk_modulus", "sound_speed");
  table.not_both("poisson_ratio", "shear_modulus");
  const std::optional<double> modulus = table.number("bulk_modulus", dimension::pressure, Bound::positive);
  const std::optional<double> speed = table.number("sound_speed", dimension::speed, Bound::positive);
  if (modulus)
    group.bulk_modulus = *modulus;
  else if (speed)
    group.bulk_modulus = group.density * *speed * *speed;
  else if (like != nullptr)
    group.bulk_modulus = like->bulk_modulus;
  else
    table.fail_missing("bulk_modulus", "give it in Pa, or sound_speed in m/s");

  if (!(group.bulk_modulus > 0 && std::isfinite(group.bulk_modulus)))
    table.fail(speed ? "sound_speed" : "bulk_modulus", "makes a modulus beyond the range of numbers",
               "check its unit");

  const bool solid = group.kind == GroupKind::solid;
  table.only_if(solid, "poisson_ratio", "only groups with kind = \"solid\" have it");
  table.only_if(solid, "shear_modulus", "only groups with kind = \"solid\" have it");
  if (!solid) return;
  if (const auto mu = table.number("shear_modulus", dimension::pressure, Bound::positive)) {
    group.shear_modulus = *mu;
  } else if (const auto nu = table.number("poisson_ratio", dimension::none, Bound::any)) {
    if (!(*nu > -1 && *nu < 0.5))
      table.fail("poisson_ratio", fmt::format("is {}", *nu), "it must be between -1 and 0.5, both excluded");
    group.shear_modulus = 3 * group.bulk_modulus * (1 - 2 * *nu) / (2 * (1 + *nu));
    if (!(group.shear_modulus > 0 && std::isfinite(group.shear_modulus)))
      table.fail("poisson_ratio", "makes a modulus beyond the range of numbers", "check it and bulk_modulus");
  } else {
    table.fail_missing("poisson_ratio", "give it, or shear_modulus in Pa");
  }
}

void read_gas(const TableReader& table, Group& group) {
  const bool bubbly = group.eos->kind == EosKind::bubbly;
  for (const std::string_view key :
       {"gas_content", "gas_rt", "solubility_pressure", "solubility_exponent", "fragmentation"})
    table.only_if(bubbly, key, "only groups with eos = \"bubbly\" have it");
  if (!bubbly) return;
  group.gas_content = table.required_number("gas_content", dimension::none, Bound::positive);
  if (group.gas_content >= 1)
    table.fail("gas_content", fmt::format("is {}", group.gas_content),
               "it is a mass per mass of liquid, below 1");
  group.gas_rt = table.required_number("gas_rt", dimension::specific_energy, Bound::positive);
  group.solubility_pressure =
      table.required_number("solubility_pressure", dimension::pressure, Bound::positive);
  group.solubility_exponent =
      table.number("solubility_exponent", dimension::none, Bound::positive).value_or(1);
}

/// `like` supplies what a wall does not say itself; nullptr for groups that must say everything.
Group read_material(const TableReader& table, const std::string& name, GroupKind kind, const Group* like,
                    int dim) {
  Group group;
  group.name = name;
  group.kind = kind;
  for (const std::string_view key : {"diameter", "young_modulus", "normal_stiffness", "tangential_stiffness",
                                     "restitution", "friction", "rolling_friction", "fixed"})
    table.only_if(false, key, "only groups with kind = \"grain\" have it");
  group.eos = table.choice("eos", eos_words()).value_or(linear_eos());
  if (kind != GroupKind::fluid && group.eos != linear_eos())
    table.fail("eos", fmt::format("is \"{}\"", *table.text("eos")),
               "only groups with kind = \"fluid\" have another than the linear law");
  if (like == nullptr)
    group.density = table.required_number("density", dimension::density, Bound::positive);
  else
    group.density = table.number("density", dimension::density, Bound::positive).value_or(like->density);
  read_stiffness(table, group, like);
  std::vector<LawWord> laws;
  for (const EquationOfState* law : equations_of_state()) laws.push_back({law->word, law->keys});
  group.eos_constants = read_law_constants(table, "eos", {group.eos->word, group.eos->keys}, laws);
  const auto viscosity = [&](std::string_view key, double fallback) {
    return table.number(key, dimension::viscosity, Bound::not_negative).value_or(fallback);
  };
  group.viscosity = viscosity("viscosity", like == nullptr ? 0 : like->viscosity);
  group.bulk_viscosity = viscosity("bulk_viscosity", like == nullptr ? 0 : like->bulk_viscosity);
  read_gas(table, group);
  table.only_if(kind == GroupKind::solid, "lagrangian", "only groups with kind = \"solid\" have it");
  group.lagrangian = table.choice("lagrangian", lagrangian_words()).value_or(Lagrangian::updated);
  table.only_if(kind == GroupKind::wall, "velocity",
                "only groups with kind = \"wall\" have it; movers start with start.velocity");
  table.only_if(kind == GroupKind::wall, "slip", "only groups with kind = \"wall\" have it");
  if (kind == GroupKind::wall) {
    group.wall_velocity = table.vector("velocity", dimension::speed, dim).value_or(Double3{});
    group.slip = table.flag("slip").value_or(false);
    table.only_if(!group.slip, "velocity", "a wall with slip = true drags nothing along");
  }
  return group;
}

/// The solid that a wall is bonded to, -1 for other groups.
int read_clamps(const TableReader& table, GroupKind kind, const std::vector<Group>& groups) {
  table.only_if(kind == GroupKind::wall, "clamps", "only groups with kind = \"wall\" have it");
  const int solid = read_group_name(table, "clamps", groups);
  if (solid < 0) return -1;
  for (const std::string_view key : {"velocity", "slip"})
    table.only_if(false, key, "a clamp holds its solid at rest");
  if (const Group& g = groups[static_cast<std::size_t>(solid)]; g.lagrangian != Lagrangian::total)
    table.fail("clamps", fmt::format("names \"{}\"", g.name),
               "it must name a solid with lagrangian = \"total\"");
  return solid;
}

/// Total-Lagrangian solids have passes of their own, in which nothing else takes part yet.
void check_total_lagrangian(const std::vector<TableReader>& tables, const std::vector<Group>& groups) {
  const bool any = std::any_of(groups.begin(), groups.end(),
                               [](const Group& g) { return g.lagrangian == Lagrangian::total; });
  for (std::size_t k = 0; any && k < groups.size(); ++k) {
    const Group& g = groups[k];
    if (g.kind == GroupKind::fluid || (g.kind == GroupKind::solid && g.lagrangian == Lagrangian::updated))
      tables[k].fail(g.kind == GroupKind::fluid ? "kind" : "lagrangian",
                     g.kind == GroupKind::fluid ? "is \"fluid\" beside total-Lagrangian solids"
                                                : "is \"updated\" beside total-Lagrangian solids",
                     "a scene of those has no other matter but walls");
    if (g.slip)
      tables[k].fail("slip", "is on", "total-Lagrangian solids touch walls without friction anyway");
    if (g.kind == GroupKind::solid && g.bulk_viscosity > 0)
      tables[k].fail("bulk_viscosity", fmt::format("is {}", g.bulk_viscosity),
                     "solids with lagrangian = \"total\" have viscosity alone");
  }
}

void check_target(const TableReader& table, const Group& from, const Group& to) {
  const auto same = [&](bool equal, std::string_view key) {
    if (!equal)
      table.fail("group",
                 fmt::format("names \"{}\", whose {} differs from that of \"{}\"", to.name, key, from.name),
                 "fragments keep the equation of state: repeat its values in both groups");
  };
  if (to.kind != GroupKind::fluid)
    table.fail("group", fmt::format("names \"{}\", which is no fluid", to.name), "fragments are a fluid");
  same(from.eos == to.eos, "eos");
  same(from.density == to.density, "density");
  same(from.bulk_modulus == to.bulk_modulus, "bulk_modulus");
  same(from.gas_rt == to.gas_rt, "gas_rt");
  same(from.solubility_pressure == to.solubility_pressure, "solubility_pressure");
  same(from.solubility_exponent == to.solubility_exponent, "solubility_exponent");
}

void read_fragmentation(const TableReader& table, std::size_t self, std::vector<Group>& groups) {
  Group& group = groups[self];
  if (!table.has("fragmentation")) return;
  const TableReader inner = table.table("fragmentation", scene_keys::fragmentation);
  const double psi = inner.required_number("void_fraction", dimension::none, Bound::positive);
  if (psi >= 1)
    inner.fail("void_fraction", fmt::format("is {}", psi), "it must be between 0 and 1, both excluded");
  (void)inner.required_text("group");
  const int target = read_group_name(inner, "group", groups);
  if (target == static_cast<int>(self))
    inner.fail("group", "names the group itself", "fragments join another group");
  check_target(inner, group, groups[static_cast<std::size_t>(target)]);
  group.fragmentation_void_fraction = psi;
  group.fragments_to = target;
}

struct Header {
  std::string name;
  GroupKind kind;
};

std::vector<Header> read_headers(const std::vector<TableReader>& tables) {
  std::vector<Header> out;
  std::vector<std::string> names;
  bool movers = false;
  for (const TableReader& t : tables) {
    names.push_back(read_name(t, "group", names));
    const std::optional<GroupKind> kind = t.choice("kind", group_kind_words());
    if (!kind) t.fail_missing("kind", "give \"fluid\", \"solid\" or \"wall\", or \"grain\" for all groups");
    movers = movers || *kind != GroupKind::wall;
    out.push_back({names.back(), *kind});
  }
  if (!movers)
    tables.front().fail("kind", "every group is a wall", "at least one group must be a fluid or a solid");
  return out;
}

}  // namespace

std::vector<Group> read_groups(const TableReader& top, int dim) {
  const std::vector<TableReader> tables = top.tables("group", scene_keys::group);
  if (tables.empty()) top.fail_missing("group", "describe each material in a [[group]] table");
  const std::vector<Header> headers = read_headers(tables);
  std::vector<Group> groups(tables.size());
  for (std::size_t k = 0; k < tables.size(); ++k) groups[k].name = headers[k].name;
  const Group* first_fluid = nullptr;
  for (const GroupKind pass : {GroupKind::fluid, GroupKind::solid, GroupKind::wall})
    for (std::size_t k = 0; k < tables.size(); ++k) {
      if (headers[k].kind != pass) continue;
      const int clamped = read_clamps(tables[k], pass, groups);
      const Group* like = clamped >= 0              ? &groups[static_cast<std::size_t>(clamped)]
                          : pass == GroupKind::wall ? first_fluid
                                                    : nullptr;
      groups[k] = read_material(tables[k], headers[k].name, pass, like, dim);
      groups[k].clamps = clamped;
      if (pass == GroupKind::fluid && first_fluid == nullptr) first_fluid = &groups[k];
    }
  check_total_lagrangian(tables, groups);
  for (std::size_t k = 0; k < tables.size(); ++k) read_fragmentation(tables[k], k, groups);
  for (std::size_t k = 0; k < tables.size(); ++k) {
    const int target = groups[k].fragments_to;
    if (target >= 0 && groups[static_cast<std::size_t>(target)].fragments_to >= 0)
      tables[k].fail("fragmentation", "leads to a group that fragments again",
                     "fragments must stay what they are");
    tables[k].finish();
  }
  return groups;
}

std::string read_name(const TableReader& table, std::string_view what,
                      const std::vector<std::string>& earlier) {
  const std::string name = table.required_text("name");
  const auto allowed = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
  };
  bool good = !name.empty() && std::isalpha(static_cast<unsigned char>(name.front())) != 0;
  for (char c : name) good = good && allowed(c);
  if (!good)
    table.fail("name", fmt::format("is \"{}\"", name),
               "a name is a letter followed by letters, digits, _ or -");
  if (name == "none")
    table.fail("name", "is \"none\"", "that word means an empty region; choose another name");
  if (std::find(earlier.begin(), earlier.end(), name) != earlier.end())
    table.fail("name", fmt::format("\"{}\" is taken by an earlier {}", name, what),
               fmt::format("give each {} its own name", what));
  return name;
}

int group_of_name(const TableReader& table, std::string_view key, const std::string& name,
                  const std::vector<Group>& groups) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < groups.size(); ++k) {
    if (groups[k].name == name) return static_cast<int>(k);
    names.push_back(groups[k].name);
  }
  table.fail(key, fmt::format("names the unknown group \"{}\"", name), suggestion(name, names));
}

int read_group_name(const TableReader& table, std::string_view key, const std::vector<Group>& groups) {
  const std::optional<std::string> name = table.text(key);
  return name ? group_of_name(table, key, *name, groups) : -1;
}

}  // namespace sph
