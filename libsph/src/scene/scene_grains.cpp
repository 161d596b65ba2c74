// [[group]] with kind = "grain", and what a scene of grains does not share with one of SPH.
#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <optional>

#include "scene/scene_resolve.hpp"
#include "sph/contact/law.hpp"
#include "sph/grain_mass.hpp"

namespace sph {
namespace {

constexpr std::string_view only_grains =
    "only scenes of grains have it, where every [[group]] has kind = \"grain\"";

void read_radii(const TableReader& table, Group& group) {
  const toml_tree::Node* value = table.find("diameter");
  if (value == nullptr) return;
  const toml_tree::Array* range = value->array();
  double least = 0, largest = 0;
  if (range == nullptr) {
    least = largest = *table.number("diameter", dimension::length, Bound::positive);
  } else {
    if (range->size() != 2)
      table.fail("diameter", fmt::format("has {} values", range->size()),
                 "it must be one length, or an array of the least and the largest");
    least = table.to_number((*range)[0], "diameter", dimension::length);
    largest = table.to_number((*range)[1], "diameter", dimension::length);
    if (!(least > 0)) table.fail("diameter", fmt::format("begins with {}", least), "it must be positive");
    if (!(least <= largest))
      table.fail("diameter", fmt::format("runs from {} down to {}", least, largest),
                 "give the least first, then the largest");
  }
  group.grain.least_radius = 0.5 * least;
  group.grain.largest_radius = 0.5 * largest;
}

/// A material of walls alone has no diameter, and then no grains that could be heavy or fixed.
void read_body(const TableReader& table, Group& group) {
  read_radii(table, group);
  const GrainMaterial& g = group.grain;
  const bool has_grains = g.largest_radius > 0;
  if (table.has("diameter") && !(g.least_radius > 0))
    table.fail("diameter", "is below the range of numbers", "check its unit");
  group.density = has_grains ? table.required_number("density", dimension::density, Bound::positive)
                             : table.number("density", dimension::density, Bound::positive).value_or(0);
  const double lightest = grain_mass(group.density, g.least_radius);
  if (has_grains && !(lightest > 0 && std::isfinite(grain_mass(group.density, g.largest_radius))))
    table.fail("diameter", "makes a mass beyond the range of numbers", "check its unit and the density's");
  table.only_if(has_grains, "fixed", "a material without diameter has no grains: it is for walls");
  group.grain.fixed = table.flag("fixed").value_or(false);
  table.only_if(group.grain.fixed, "velocity",
                "only grains with fixed = true have it; the others start with start.velocity");
  group.wall_velocity = table.vector("velocity", dimension::speed, 3).value_or(Double3{});
}

void read_contact_material(const TableReader& table, GrainMaterial& g, const ContactControl& contact) {
  std::vector<LawWord> laws;
  for (const ContactLaw* law : contact_laws()) laws.push_back({law->word, law->keys});
  g.constants = read_law_constants(table, "contact.law", {contact.law->word, contact.law->keys}, laws);
  table.only_if(!contact.normal_damping, "restitution", "contact.normal_damping stands instead of it");
  if (!contact.normal_damping) {
    g.restitution = table.required_number("restitution", dimension::none, Bound::positive);
    if (g.restitution > 1)
      table.fail("restitution", fmt::format("is {}", g.restitution), "it must be above 0 and at most 1");
  }
  g.friction = table.number("friction", dimension::none, Bound::not_negative).value_or(0);
  g.rolling_friction = table.number("rolling_friction", dimension::none, Bound::not_negative).value_or(0);
}

void refuse_sph_keys(const TableReader& table) {
  for (const std::string_view key :
       {"eos", "bulk_modulus", "sound_speed", "viscosity", "bulk_viscosity", "shear_modulus", "gas_content",
        "gas_rt", "solubility_pressure", "solubility_exponent", "fragmentation"})
    table.only_if(false, key, "it is of fluids and solids; grains have a contact law");
}

}  // namespace

bool describes_grains(const TableReader& top) {
  for (const TableReader& table : top.tables("group", scene_keys::group)) {
    const toml_tree::Node* kind = table.find("kind");
    const auto* word = kind == nullptr ? nullptr : std::get_if<std::string>(&kind->value);
    if (word != nullptr && *word == "grain") return true;
  }
  return false;
}

void refuse_foreign_keys(const SharedTables& t, bool grains) {
  t.top.only_if(!grains, "formulation", "it is of SPH; grains follow from [contact]");
  t.top.only_if(!grains, "precision", "contacts are always computed in double");
  t.top.only_if(!grains, "kernel", "grains act on each other where they touch: there is no kernel");
  t.top.only_if(!grains, "terms", "they are of SPH; grains follow from [contact]");
  t.domain.only_if(!grains, "surface_pressure", "grains have no equation of state");
  for (const std::string_view key : {"central_pull", "pull_centre"})
    t.domain.only_if(!grains, key, "it is of fluids");
  t.time.only_if(!grains, "cfl", "grains have no speed of sound; give dt, or neither");
  for (const std::string_view key : {"pressure", "surface_height", "layer", "flow_speed", "flow_length"})
    t.start.only_if(!grains, key, "it is of fluids");
  t.output.only_if(!grains, "average_space", "it averages with the kernel, and grains have none");
  for (const std::string_view key : {"contact", "wall", "stage"}) t.top.only_if(grains, key, only_grains);
  t.start.only_if(grains, "tile", only_grains);
  t.output.only_if(grains, "contacts", only_grains);
}

std::vector<Group> read_grain_groups(const TableReader& top, const ContactControl& contact) {
  const std::vector<TableReader> tables = top.tables("group", scene_keys::group);
  std::vector<Group> groups;
  std::vector<std::string> names;
  bool sized = false, mobile = false;
  for (const TableReader& table : tables) {
    names.push_back(read_name(table, "group", names));
    const std::optional<GroupKind> kind = table.choice("kind", group_kind_words());
    if (!kind) table.fail_missing("kind", "give \"grain\", as another group has");
    if (*kind != GroupKind::grain)
      table.fail("kind", "differs from \"grain\", which another group has",
                 "one scene holds either grains or fluids, solids and their walls");
    refuse_sph_keys(table);
    Group group;
    group.name = names.back();
    group.kind = GroupKind::grain;
    read_body(table, group);
    read_contact_material(table, group.grain, contact);
    table.finish();
    const bool has_grains = group.grain.largest_radius > 0;
    sized = sized || has_grains;
    mobile = mobile || (has_grains && !group.grain.fixed);
    groups.push_back(std::move(group));
  }
  if (!sized)
    tables.front().fail("diameter", "is missing in every group", "give the size of the grains in m");
  if (!mobile)
    tables.front().fail("fixed", "is true in every group of grains",
                        "at least one group must be free to move");
  return groups;
}

}  // namespace sph
