// [[group]]: materials, with what each kind needs and what it must not have.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <optional>

#include "core/nearest.hpp"
#include "keys/scene_resolve.hpp"
#include "sph/laws/eos/law.hpp"

namespace sph {
namespace {

/// Elastic constants: K from the sound speed, mu from Poisson's ratio, as the paper's readers know them.
void read_stiffness(const GroupReader& table, Group& group, const std::vector<Group>& groups) {
  using Name = GroupReader::Name<>;
  table.not_both("bulk_modulus", "sound_speed");
  table.not_both("poisson_ratio", "shear_modulus");
  if (group.eos.law->kind == EosKind::ideal_gas)
    group.eos.bulk_modulus = group.eos.gas.heat_ratio * group.eos.gas.start_pressure;
  const std::optional<double> speed = table.number("sound_speed");
  if (speed) group.eos.bulk_modulus = group.density * *speed * *speed;
  const bool rigid = group.kind == GroupKind::solid && group.solid.body.rigid;
  if (group.eos.bulk_modulus == 0 && !speed && rigid)
    group.eos.bulk_modulus = stiffness_of_rigid(table, group, groups);
  if (group.eos.bulk_modulus == 0 && !speed && group.eos.law->kind != EosKind::ideal_gas)
    table.fail_missing("bulk_modulus", "give it in Pa, or sound_speed in m/s");
  const std::string_view beyond = "makes a modulus beyond the range of numbers";
  if (!(group.eos.bulk_modulus > 0 && std::isfinite(group.eos.bulk_modulus)))
    table.fail(speed                                       ? Name("sound_speed")
               : group.eos.law->kind == EosKind::ideal_gas ? Name("start_pressure")
                                                           : Name("bulk_modulus"),
               beyond, "check its unit");

  const bool solid = group.kind == GroupKind::solid;
  table.only_if(solid, "poisson_ratio", "only groups with kind = \"solid\" have it");
  if (!solid || rigid || table.has("shear_modulus")) return;
  const std::optional<double> nu = table.number("poisson_ratio");
  if (!nu) table.fail_missing("poisson_ratio", "give it, or shear_modulus in Pa");
  if (!(*nu > -1 && *nu < 0.5))
    table.fail("poisson_ratio", fmt::format("is {}", *nu), "it must be between -1 and 0.5, both excluded");
  group.solid.shear_modulus = 3 * group.eos.bulk_modulus * (1 - 2 * *nu) / (2 * (1 + *nu));
  if (!(group.solid.shear_modulus > 0 && std::isfinite(group.solid.shear_modulus)))
    table.fail("poisson_ratio", beyond, "check it and bulk_modulus");
}

/// `like` supplies what a wall does not say itself; nullptr for groups that must say everything.
void read_material(const GroupReader& table, Group& group, const Group* like,
                   const std::vector<Group>& groups) {
  if (like != nullptr) {
    group.density = like->density;
    group.eos.bulk_modulus = like->eos.bulk_modulus;
    group.viscosity = like->viscosity;
    group.viscosity_law.bulk = like->viscosity_law.bulk;
  }
  const bool wall = group.kind == GroupKind::wall;
  if (const auto word = table.text("eos");
      word && group.kind != GroupKind::fluid && *word != linear_eos()->word &&
      std::ranges::any_of(equations_of_state(), [&](const EquationOfState* e) { return e->word == *word; }))
    table.fail("eos", fmt::format("is \"{}\"", *word),
               "only groups with kind = \"fluid\" have another than the linear law");
  table.read(group);
  if (like == nullptr) table.require("density");
  read_stiffness(table, group, groups);
  std::vector<LawWord> laws;
  for (const EquationOfState* law : equations_of_state()) laws.push_back({law->word, law->keys});
  group.eos.constants = read_law_constants(table, "eos", {group.eos.law->word, group.eos.law->keys}, laws);
  table.only_if(wall, "velocity",
                "only groups with kind = \"wall\" have it; movers start with start.velocity");
  if (!wall) return;
  group.wall.velocity = table.vector("velocity").value_or(Double3{});
  group.wall.slip = table.flag("slip").value_or(false);
  table.only_if(!group.wall.slip, "velocity", "a wall with slip = true drags nothing along");
}

/// The solid that a wall is bonded to, -1 for other groups.
int read_clamps(const GroupReader& table, const Group& group, const std::vector<Group>& groups) {
  if (group.kind != GroupKind::wall || !table.has("clamps")) return -1;
  const int solid = *table.index("clamps");
  table.only_if(false, "velocity", "a clamp holds its solid at rest");
  table.only_if(false, "slip", "a clamp holds its solid at rest");
  const Group& g = groups[static_cast<std::size_t>(solid)];
  if (is_rigid(g))
    table.fail("clamps", fmt::format("names \"{}\", which is rigid", g.name),
               "what holds a rigid body is its key held");
  if (g.solid.lagrangian != Lagrangian::total)
    table.fail("clamps", fmt::format("names \"{}\"", g.name),
               "it must name a solid with lagrangian = \"total\"");
  return solid;
}

/// Total-Lagrangian solids have passes of their own, in which not all else takes part yet.
void check_total_lagrangian(const std::vector<GroupReader>& tables, const std::vector<Group>& groups) {
  if (std::ranges::none_of(groups, is_body)) return;
  const bool wet = std::ranges::any_of(groups, [](const Group& g) { return g.kind == GroupKind::fluid; });
  for (std::size_t k = 0; k < groups.size(); ++k) {
    const Group& g = groups[k];
    if (g.eos.law->kind == EosKind::ideal_gas)
      tables[k].fail("eos", "is \"ideal_gas\" beside total-Lagrangian solids",
                     "liquids alone press on them yet");
    if (g.bubbly.permeability.coefficient > 0 || g.bubbly.exsolution_time > 0 || g.viscosity_law.varies())
      tables[k].fail("kind", "is of a fluid with gas flow or a viscosity law beside total-Lagrangian solids",
                     "a fluid beside them has one viscosity and keeps its gas yet");
    if (g.kind == GroupKind::solid && g.solid.lagrangian == Lagrangian::updated)
      tables[k].fail("lagrangian", "is \"updated\" beside total-Lagrangian solids",
                     "solids of a scene are all \"total\" or all \"updated\"");
    if (g.wall.slip && !wet)
      tables[k].fail("slip", "is on", "total-Lagrangian solids touch walls without friction anyway");
    if (g.kind == GroupKind::solid && g.viscosity_law.bulk > 0)
      tables[k].fail("bulk_viscosity", fmt::format("is {}", g.viscosity_law.bulk),
                     "solids with lagrangian = \"total\" have viscosity alone");
  }
}

using BecomesReader = Reader<keys::becomes>;

void check_failure(const BecomesReader& row, const Transition& change, const Group& group, const Group& to) {
  const bool total = is_bonded(group);
  row.only_if(total, "toughness", "only solids with lagrangian = \"total\" fail so");
  row.only_if(total, "tensile_strength", "only solids with lagrangian = \"total\" fail so");
  row.only_if(total, "cohesion", "only solids with lagrangian = \"total\" fail so");
  if (change.failure.friction_angle != 0 && !change.failure.cohesion)
    row.fail("friction_angle", "is given without cohesion", "give that too");
  if (!change.of_failure()) {
    if (change.keeps != Conserved::mass)
      row.fail("keeps", change.keeps == Conserved::volume ? "is \"volume\"" : "is \"both\"",
               "what does not fail keeps its mass: remove it");
    return;
  }
  if (change.hold > 0)
    row.fail("hold", fmt::format("is {} s", change.hold), "what fails does so at once: remove it");
  if (change.failure.toughness && change.failure.tensile_strength)
    row.fail("tensile_strength", "is given with toughness", "give one of them");
  for (const Transition& other : group.becomes)
    if (other.of_failure())
      row.fail("group", "is the second that the solid fails into", "give one row of failure");
  constexpr double alike = 0.02;
  if (change.keeps == Conserved::mass && std::abs(to.density / group.density - 1) > alike)
    row.fail(
        "group", fmt::format("is of {} kg/m3, and what fails of {}", to.density, group.density),
        "with its mass it would have another volume at once: give keeps = \"volume\", or a fluid as dense");
  if (change.keeps == Conserved::both && (to.density != group.density || to.eos.law->kind == EosKind::bubbly))
    row.fail(
        "keeps",
        fmt::format("is \"both\" where a fluid of {} kg/m3 comes of {} kg/m3", to.density, group.density),
        "its pressure would jump: give keeps = \"volume\", or a liquid as dense");
}

void read_becomes(const GroupReader& table, std::size_t self, std::vector<Group>& groups) {
  Group& group = groups[self];
  for (const auto& row : table.tables<keys::becomes>()) {
    Transition change;
    row.read(change);
    const Group& to = groups[static_cast<std::size_t>(change.group)];
    if (change.group == static_cast<int>(self))
      row.fail("group", "names the group itself", "its particles join another");
    if (!is_matter(to))
      row.fail("group", fmt::format("names \"{}\", which is no fluid and no solid", to.name),
               "only these can be joined");
    const auto stays = [&](const Group& g) {
      return g.eos.law->kind == EosKind::ideal_gas ||
             (is_body(g) && !(&g == &group && change.of_failure() && to.kind == GroupKind::fluid));
    };
    if (stays(group) || stays(to))
      row.fail("group", fmt::format("leads from \"{}\" to \"{}\"", group.name, to.name),
               "ideal gases and total-Lagrangian solids stay what they are; where these fail they become "
               "fluid: give "
               "toughness, tensile_strength or cohesion");
    if (change.limits() == 0)
      row.fail_missing("void_fraction_above",
                       "give that, void_fraction_below, temperature_above or temperature_below");
    check_failure(row, change, group, to);
    if (change.limits() > 1)
      row.fail("group", fmt::format("is joined at {} limits", change.limits()), "give each a row of its own");
    const bool warm = group.heat.material.specific_heat > 0, bubbly = group.eos.law->kind == EosKind::bubbly;
    row.only_if(warm, "temperature_above", "there is no heat: give group.heat");
    row.only_if(warm, "temperature_below", "there is no heat: give group.heat");
    row.only_if(bubbly, "void_fraction_above", "the group has no gas: set eos = \"bubbly\"");
    row.only_if(bubbly, "void_fraction_below", "the group has no gas: set eos = \"bubbly\"");
    for (const Transition& other : group.becomes)
      if (change.average > 0 && other.average > 0 && other.average != change.average &&
          other.of_temperature() == change.of_temperature())
        row.fail("average", fmt::format("is {} s, and {} s in a row before", change.average, other.average),
                 "a particle keeps one mean of a quantity: give both rows the same");
    row.finish();
    group.becomes.push_back(change);
  }
}

/// What grains act on besides each other: fluids.
void refuse_bad_company(const std::vector<GroupReader>& tables, const std::vector<Group>& groups) {
  const auto has = [&](GroupKind k) {
    return std::ranges::any_of(groups, [k](const Group& g) { return g.kind == k; });
  };
  for (std::size_t k = 0; k < tables.size(); ++k)
    if (has(GroupKind::melt) && groups[k].kind != GroupKind::melt && groups[k].kind != GroupKind::grain)
      tables[k].fail(
          "kind", "is no melt, and the scene has some",
          "melts share a scene with melts and grains alone; their walls are the sides of the domain, "
          "[[melt.side]]");
  if (!has(GroupKind::grain)) return;
  for (std::size_t k = 0; k < tables.size(); ++k) {
    if (groups[k].kind == GroupKind::solid)
      tables[k].fail("kind", "is \"solid\" beside grains",
                     "grains act on fluids and on each other alone: they would pass through it");
    if (groups[k].kind == GroupKind::wall && !has(GroupKind::fluid))
      tables[k].fail("kind", "is \"wall\" in a scene of grains alone",
                     "grains are held by [[wall]], whose material is a group of kind = \"grain\"");
  }
}

}  // namespace

std::vector<Group> read_group_names(const TopReader& top) {
  const std::vector<GroupReader> tables = top.tables<keys::group>();
  if (tables.empty()) top.fail_missing("group", "describe each material in a [[group]] table");
  std::vector<Group> groups;
  std::vector<std::string> names;
  bool movers = false;
  for (const GroupReader& table : tables) {
    Group& group = groups.emplace_back();
    names.push_back(read_name(table, "group", names));
    group.name = names.back();
    group.kind = table.choice<GroupKind>("kind").value_or(GroupKind::wall);
    movers = movers || group.kind != GroupKind::wall;
  }
  for (const GroupReader& table : tables)
    if (!table.has("kind"))
      table.fail_missing("kind", "give \"fluid\", \"solid\", \"wall\", \"grain\" or \"melt\"");
  refuse_bad_company(tables, groups);
  if (!movers)
    tables.front().fail("kind", "every group is a wall",
                        "at least one group must be a fluid, a solid, of grains or a melt");
  return groups;
}

void read_groups(const TopReader& top, Scene& scene) {
  const std::vector<GroupReader> tables = top.tables<keys::group>();
  std::vector<Group>& groups = scene.groups;
  const Group* first_fluid = nullptr;
  for (const GroupKind pass : {GroupKind::fluid, GroupKind::solid, GroupKind::wall})
    for (std::size_t k = 0; k < tables.size(); ++k) {
      Group& group = groups[k];
      if (group.kind != pass) continue;
      const int clamped = read_clamps(tables[k], group, groups);
      const Group* like = clamped >= 0              ? &groups[static_cast<std::size_t>(clamped)]
                          : pass == GroupKind::wall ? first_fluid
                                                    : nullptr;
      read_material(tables[k], group, like, groups);
      if (pass == GroupKind::solid) read_rigid(tables[k], group, scene.dim);
      read_exchange(tables[k], group);
      read_strength(tables[k], group, scene);
      if (pass == GroupKind::fluid && first_fluid == nullptr) first_fluid = &group;
    }
  check_total_lagrangian(tables, groups);
  check_exchange(tables, scene);
  for (std::size_t k = 0; k < tables.size(); ++k) {
    if (groups[k].kind == GroupKind::grain) continue;
    read_becomes(tables[k], k, groups);
    tables[k].finish();
  }
  check_parts(tables, groups);
}

std::string read_name(const TableReader& table, std::string_view what,
                      const std::vector<std::string>& earlier) {
  const Key& key = table.key("name");
  table.require(key);
  const std::string name = *table.get<&KeyValue::text>(key);
  const auto allowed = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
  };
  bool good = !name.empty() && std::isalpha(static_cast<unsigned char>(name.front())) != 0;
  for (char c : name) good = good && allowed(c);
  if (!good)
    table.fail(key, fmt::format("is \"{}\"", name), "a name is a letter followed by letters, digits, _ or -");
  if (name == "none") table.fail(key, "is \"none\"", "that word means an empty region; choose another name");
  if (std::find(earlier.begin(), earlier.end(), name) != earlier.end())
    table.fail(key, fmt::format("\"{}\" is taken by an earlier {}", name, what),
               fmt::format("give each {} its own name", what));
  return name;
}

}  // namespace sph
