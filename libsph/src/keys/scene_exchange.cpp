// What groups exchange and how their state makes them flow: [group.heat], [group.permeability], [group.viscosity_law].
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "keys/scene_resolve.hpp"
#include "sph/laws/eos/law.hpp"
#include "sph/laws/melt_viscosity.hpp"

namespace sph {
namespace {

bool any_grains(const std::vector<Group>& groups) {
  return std::ranges::any_of(groups, [](const Group& g) { return g.kind == GroupKind::grain; });
}

void read_permeability(const GroupReader& table, Group& group) {
  if (!table.has("permeability")) return;
  const auto inner = table.table<keys::permeability>();
  if (inner.choice<PermeabilityLaw>("law") == PermeabilityLaw::percolation)
    group.bubbly.permeability.exponent = 2;
  inner.read(group.bubbly.permeability);
  if (group.bubbly.permeability.law == PermeabilityLaw::kozeny_carman && !inner.has("exponent"))
    group.bubbly.permeability.exponent = 0;  // not written
  inner.only_if(group.bubbly.permeability.law != PermeabilityLaw::kozeny_carman, "exponent",
                "law = \"kozeny_carman\" has none");
  inner.only_if(group.bubbly.permeability.inertial_coefficient > 0, "inertial_exponent",
                "give inertial_coefficient too");
  if (group.bubbly.permeability.inertial_coefficient == 0)
    group.bubbly.permeability.inertial_exponent = -1;  // not written
  if (const Permeability& m = group.bubbly.permeability;
      m.closing_threshold && *m.closing_threshold > m.threshold)
    inner.fail("closing_threshold", fmt::format("is {}, above threshold", *m.closing_threshold),
               "bubbles that part at less than what connects them keep it below");
  inner.finish();
}

/// Where what is dissolved follows the pressure at once it is no state of its own: its gradients are those of the pressure.
void read_water(const GroupReader& table, const Group& group) {
  if (group.bubbly.water_diffusivity > 0 && group.bubbly.exsolution_time == 0)
    table.fail("water_diffusivity", "is given, and what is dissolved follows the pressure at once",
               "give exsolution_time too");
}

void check_gas_flow(const std::vector<GroupReader>& tables, const Scene& scene) {
  const std::vector<Group>& groups = scene.groups;
  const bool grains = any_grains(groups);
  for (std::size_t k = 0; k < groups.size(); ++k) {
    using Name = GroupReader::Name<>;
    const BubblyMaterial& m = groups[k].bubbly;
    for (const auto& [given, key] : {std::pair(m.permeability.coefficient, Name("permeability")),
                                     std::pair(m.water_diffusivity, Name("water_diffusivity"))})
      if (grains && given > 0)
        tables[k].fail(key, "is of a fluid with grains in it", "fluids without grains alone have it yet");
  }
  const bool flows =
      std::ranges::any_of(groups, [](const Group& g) { return g.bubbly.permeability.coefficient > 0; });
  for (std::size_t k = 0; k < groups.size(); ++k) {
    if (groups[k].kind != GroupKind::wall) continue;
    tables[k].only_if(flows, "gas_pressure", "no gas flows: give a bubbly fluid group.permeability");
    const double above = groups[k].wall.gas_pressure.value_or(0), surface = scene.domain.surface_pressure;
    if (above < -surface)
      tables[k].fail("gas_pressure", fmt::format("is {:.6g} Pa below nothing", -surface - above),
                     fmt::format("no gas has less than none: it must be at least {} Pa", 0 - surface));
  }
}

void read_heat(const GroupReader& table, Group& group) {
  if (!table.has("heat")) return;
  const auto inner = table.table<keys::heat>();
  inner.read(group.heat.material);
  const HeatMaterial& heat = group.heat.material;
  if (heat.latent_heat > 0) {
    inner.require("solidus");
    inner.require("liquidus");
    if (!(heat.solidus < heat.liquidus))
      inner.fail("liquidus", fmt::format("is {} K, and solidus {} K", heat.liquidus, heat.solidus),
                 "it must be above: the latent heat is spread between them");
  } else {
    inner.only_if(false, "solidus", "give latent_heat too");
    inner.only_if(false, "liquidus", "give latent_heat too");
  }
  if (heat.expansion > 0 && !inner.has("reference_temperature"))
    group.heat.material.reference_temperature = group.heat.temperature.value_or(0);
  inner.finish();
}

/// Heat by a coefficient and by radiation add up; a temperature or a flux stands alone.
void read_wall_heat(const GroupReader& table, Group& group) {
  if (table.has("heat_transfer")) {
    const auto inner = table.table<keys::heat_transfer>();
    inner.read(group.heat.transfer);
    inner.finish();
  }
  if (table.has("radiation")) {
    const auto inner = table.table<keys::radiation>();
    inner.read(group.heat.radiation);
    inner.finish();
  }
  using Name = GroupReader::Name<>;
  for (const Name way : {Name("heat_transfer"), Name("radiation")})
    for (const Name other : {Name("temperature"), Name("heat_flux")}) table.not_both(other, way);
}

/// All matter has heat, or none; what has starts with a temperature.
void check_heat(const std::vector<GroupReader>& tables, const std::vector<Group>& groups) {
  const auto warm = [](const Group& g) { return g.heat.material.specific_heat > 0; };
  const bool any = std::ranges::any_of(groups, warm);
  for (std::size_t k = 0; k < groups.size(); ++k) {
    const Group& g = groups[k];
    if (!is_matter(g) && g.kind != GroupKind::wall) continue;
    if (!any) {
      tables[k].only_if(false, "temperature", "there is no heat: give a fluid or a solid group.heat");
      using Name = GroupReader::Name<>;
      for (const Name way : {Name("heat_flux"), Name("heat_transfer"), Name("radiation")})
        tables[k].only_if(false, way, "there is no heat: give a fluid or a solid group.heat");
      continue;
    }
    if (any_grains(groups) && warm(g))
      tables[k].fail("heat", "is of a fluid with grains in it", "fluids without grains alone have it yet");
    if (is_matter(g) && !warm(g))
      tables[k].fail_missing("heat", "another group has it, and heat would end at this one");
    if (is_matter(g)) tables[k].require("temperature");
    if (g.heat.temperature && !(*g.heat.temperature >= 0))
      tables[k].fail("temperature", fmt::format("is {}", *g.heat.temperature), "it is in kelvin, from 0 up");
    tables[k].not_both("temperature", "heat_flux");
    if (g.kind == GroupKind::solid && g.solid.lagrangian == Lagrangian::total)
      tables[k].fail("heat", "is of a total-Lagrangian solid", "fluids and updated solids alone have it yet");
    if (g.eos.law->kind == EosKind::ideal_gas)
      tables[k].fail("heat", "is of an ideal gas", "it has heat of its own, which is not conducted");
  }
}

void read_viscosity_law(const GroupReader& table, Group& group) {
  if (!table.has("viscosity_law")) return;
  const auto inner = table.table<keys::viscosity_law>();
  ViscosityModel& m = group.viscosity_law;
  inner.read(m);
  const bool bubbly = group.eos.law->kind == EosKind::bubbly, by_state = m.law != ViscosityLaw::constant;
  const bool of_table = m.law == ViscosityLaw::vogel || m.law == ViscosityLaw::hess_dingwell;
  if (group.eos.law->kind == EosKind::ideal_gas)
    table.fail("viscosity_law", "is of an ideal gas", "liquids alone have it");
  if (!m.varies())
    inner.fail("law", "is \"constant\" without crystals and bubbles", "give viscosity alone, and no law");
  table.only_if(!(of_table && group.viscosity > 0), "viscosity", "group.viscosity_law says it");
  if (!of_table && !(group.viscosity > 0))
    table.fail_missing("viscosity", "group.viscosity_law multiplies it");
  if (m.law == ViscosityLaw::hess_dingwell && !bubbly)
    inner.fail("law", "is \"hess_dingwell\", and nothing is dissolved", "set eos = \"bubbly\"");
  if (m.bubbles != BubbleLaw::none && !bubbly)
    inner.fail("bubbles", "are of a fluid that has none", "set eos = \"bubbly\"");
  if (m.crystals != CrystalLaw::none) {
    if (group.heat.material.latent_heat == 0)
      inner.fail("crystals", "are of a melt that does not freeze", "give group.heat.latent_heat");
    inner.require("most");
    if (!(m.maximum_packing > 0))
      inner.fail("maximum_packing", "is 0", "it is the share of crystals at which nothing flows, 0.6 or so");
  }
  if (m.most && *m.most < m.least)
    inner.fail("most", fmt::format("is {} Pa s, less than least", *m.most), "it must not be below it");
  const bool warm = group.heat.material.specific_heat > 0;
  inner.only_if(!warm && by_state, "temperature",
                warm ? "the fluid has one that it follows" : "no law asks for it");
  if (!warm && by_state) inner.require("temperature");
  if ((m.temperature || group.heat.temperature) && !std::isfinite(viscosity_at_start(group)))
    inner.fail_missing("most", "at the start the melt is below c, a glass, for which the law has no number");
  inner.finish();
}

void check_viscosity_laws(const std::vector<GroupReader>& tables, const std::vector<Group>& groups) {
  for (std::size_t k = 0; k < groups.size(); ++k)
    if (groups[k].viscosity_law.varies() && any_grains(groups))
      tables[k].fail("viscosity_law", "is of a fluid with grains in it",
                     "fluids without grains alone have it yet");
}

}  // namespace

void read_exchange(const GroupReader& table, Group& group) {
  read_permeability(table, group);
  read_water(table, group);
  read_heat(table, group);
  if (group.kind == GroupKind::wall) read_wall_heat(table, group);
  read_viscosity_law(table, group);
}

void check_exchange(const std::vector<GroupReader>& tables, const Scene& scene) {
  check_heat(tables, scene.groups);
  check_gas_flow(tables, scene);
  check_viscosity_laws(tables, scene.groups);
}

}  // namespace sph
