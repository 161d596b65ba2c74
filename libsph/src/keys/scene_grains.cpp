// [[group]] with kind = "grain".
#include <fmt/format.h>

#include <cstddef>
#include <optional>
#include <string>

#include "keys/scene_resolve.hpp"
#include "sph/laws/contact/law.hpp"
#include "sph/scene/grain_mass.hpp"

namespace sph {
namespace {

void read_radii(const GroupReader& table, Group& group) {
  const std::optional<KeyValue> value = table.value("diameter");
  if (!value) return;
  const toml_tree::Array* range = value->node().array();
  double least = 0, largest = 0;
  if (range == nullptr) {
    least = largest = value->number_in(value->node(), dimension::length);
    if (!(least > 0)) table.fail("diameter", fmt::format("is {}", least), "it must be positive");
  } else {
    if (range->size() != 2)
      table.fail("diameter", fmt::format("has {} values", range->size()),
                 "it must be one length, or an array of the least and the largest");
    least = value->number_in((*range)[0], dimension::length);
    largest = value->number_in((*range)[1], dimension::length);
    if (!(least > 0)) table.fail("diameter", fmt::format("begins with {}", least), "it must be positive");
    if (!(least <= largest))
      table.fail("diameter", fmt::format("runs from {} down to {}", least, largest),
                 "give the least first, then the largest");
  }
  group.grain.least_radius = 0.5 * least;
  group.grain.largest_radius = 0.5 * largest;
}

/// Forces and energies of grains have powers of their masses and volumes.
void check_masses(const GroupReader& table, const Group& group) {
  constexpr double least = 1e-60, most = 1e60;
  const auto fits = [&](double density) {
    return grain_mass(density, group.grain.least_radius) >= least &&
           grain_mass(density, group.grain.largest_radius) <= most;
  };
  if (fits(group.density)) return;
  const std::string what = "makes a mass that is beyond all reason";
  const std::string right = fmt::format("grains are {} to {} kg: check its unit", least, most);
  if (fits(1)) table.fail("density", what, right);
  table.fail("diameter", what, right);
}

/// A material of walls alone has no diameter, and then no grains that could be heavy or fixed.
void read_body(const GroupReader& table, Group& group) {
  read_radii(table, group);
  const GrainMaterial& g = group.grain;
  const bool has_grains = g.largest_radius > 0;
  if (table.has("diameter") && !(g.least_radius > 0))
    table.fail("diameter", "is below the range of numbers", "check its unit");
  if (has_grains) table.require("density");
  if (has_grains) check_masses(table, group);
  table.only_if(has_grains || !g.fixed, "fixed",
                "a material without diameter has no grains: it is for walls");
  table.only_if(g.fixed, "velocity",
                "only grains with fixed = true have it; the others start with start.velocity");
  group.wall.velocity = table.vector("velocity").value_or(Double3{});
}

void read_contact_material(const GroupReader& table, GrainMaterial& g, const ContactControl& contact) {
  std::vector<LawWord> laws;
  for (const ContactLaw* law : contact_laws()) laws.push_back({law->word, law->keys});
  g.constants = read_law_constants(table, "contact.law", {contact.law->word, contact.law->keys}, laws);
}

}  // namespace

void read_grain_groups(const TopReader& top, Scene& scene) {
  const std::vector<GroupReader> tables = top.tables<keys::group>();
  bool sized = false, mobile = false;
  const GroupReader* first = nullptr;
  for (std::size_t k = 0; k < tables.size(); ++k) {
    Group& group = scene.groups[k];
    if (group.kind != GroupKind::grain) continue;
    if (first == nullptr) first = &tables[k];
    tables[k].read(group);
    read_body(tables[k], group);
    read_contact_material(tables[k], group.grain, scene.grains.contact);
    tables[k].finish();
    const bool has_grains = group.grain.largest_radius > 0;
    sized = sized || has_grains;
    mobile = mobile || (has_grains && !group.grain.fixed);
  }
  if (!sized) first->fail("diameter", "is missing in every group", "give the size of the grains in m");
  if (!mobile && !scene.has_matter())
    first->fail("fixed", "is true in every group of grains", "at least one group must be free to move");
}

}  // namespace sph
