// Ideal gases: their keys, and what has no meaning beside them.
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "scene/scene_resolve.hpp"
#include "sph/eos/law.hpp"

namespace sph {

// K = gamma p_0, and with it the speed of sound at the start.
void read_ideal_gas(const TableReader& table, Group& group) {
  for (const std::string_view key : {"bulk_modulus", "sound_speed"})
    table.only_if(false, key, "an ideal gas has heat_ratio and start_pressure");
  table.only_if(false, "bulk_viscosity", "an ideal gas has viscosity alone");
  group.heat_ratio = table.required_number("heat_ratio", dimension::none, Bound::positive);
  if (group.heat_ratio <= 1)
    table.fail("heat_ratio", fmt::format("is {}", group.heat_ratio),
               "it is that of the heat capacities, above 1: 1.4 for air");
  group.start_pressure = table.required_number("start_pressure", dimension::pressure, Bound::positive);
  group.bulk_modulus = group.heat_ratio * group.start_pressure;
}

// Walls are as thick as a kernel that has not grown, and as coarse as one that has not shrunk.
void read_growth(const TableReader& kernel, Scene& scene) {
  constexpr double narrowest = 0.05, widest = 20, in_the_open = 3;
  const bool gas = scene.has_eos(EosKind::ideal_gas), walls = scene.has_kind(GroupKind::wall);
  const auto number = [&](std::string_view key, double otherwise, double least, double most) {
    kernel.only_if(gas, key, "only scenes with eos = \"ideal_gas\" have it");
    if (!gas) return 1.0;
    const double found =
        kernel.number(key, dimension::none, Bound::positive).value_or(walls ? 1.0 : otherwise);
    if (found < least || found > most)
      kernel.fail(key, fmt::format("is {}", found), fmt::format("it must be {} to {}", least, most));
    return found;
  };
  scene.least_growth = number("least_growth", narrowest, narrowest, 1);
  scene.largest_growth = number("largest_growth", in_the_open, 1, widest);
}

// Where it is not given, kernels grow no wider than short periods have room for: `cells` of them, with a skin
// as is usual. That of the scene must not decide: it may change no bit.
void fit_growth(const TableReader& kernel, Scene& scene, double cells) {
  if (!scene.has_eos(EosKind::ideal_gas) || kernel.has("largest_growth")) return;
  constexpr double margin = 1 - 1e-9, usual_skin = 0.2;
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dim); ++a)
    if (scene.periodic[a]) {
      const double room = (scene.upper[a] - scene.lower[a]) / (cells * scene.support());
      scene.largest_growth = std::clamp((room - usual_skin) * margin, 1.0, scene.largest_growth);
    }
}

// A gas is rarely without shocks.
void read_shock_terms(const TableReader& table, Scene& scene) {
  const bool gas = scene.has_eos(EosKind::ideal_gas);
  const auto number = [&](std::string_view key, double of_gas) {
    return table.number(key, dimension::none, Bound::not_negative).value_or(gas ? of_gas : 0.0);
  };
  for (const std::string_view key : {"quadratic_viscosity", "artificial_conduction"})
    table.only_if(gas, key, "only scenes with eos = \"ideal_gas\" have it");
  Terms& terms = scene.terms;
  terms.artificial_viscosity = number("artificial_viscosity", 1);
  terms.quadratic_viscosity = number("quadratic_viscosity", 2);
  terms.conduction = number("artificial_conduction", 0.3);
  if (gas) terms.density_diffusion = 0;
}

// Their density is a sum over neighbours, that of other matter an integral over time.
void check_ideal_gas(const TableReader& top, const TableReader& domain, const TableReader& start,
                     const TableReader& terms, const Scene& scene) {
  if (!scene.has_eos(EosKind::ideal_gas)) return;
  const std::vector<TableReader> groups = top.tables("group", scene_keys::group);
  for (std::size_t k = 0; k < groups.size(); ++k)
    if (const Group& g = scene.groups[k]; g.kind != GroupKind::wall && g.eos->kind != EosKind::ideal_gas)
      groups[k].fail(
          g.kind == GroupKind::solid ? "kind" : "eos",
          fmt::format("is \"{}\" beside an ideal gas", g.kind == GroupKind::solid ? "solid" : g.eos->word),
          "a scene with ideal gases has no other matter but walls");
  if (scene.formulation == Formulation::ida)
    top.fail("formulation", "is \"ida\"", "it has no energy equation, which an ideal gas needs");
  if (scene.start.pressure == InitialPressure::hydrostatic)
    start.fail("pressure", "is \"hydrostatic\"",
               "an ideal gas starts from start_pressure, or from the column u of start.file");
  const double speed = scene.start.flow_speed;
  for (std::size_t k = 0; k < groups.size(); ++k)
    if (const Group& g = scene.groups[k]; scene.start.pressure == InitialPressure::taylor_green &&
                                          g.kind != GroupKind::wall &&
                                          g.start_pressure <= 0.5 * g.density * speed * speed)
      groups[k].fail("start_pressure", fmt::format("is {}", g.start_pressure),
                     "with start.pressure = \"taylor_green\" it must be above rho U^2 / 2");
  if (scene.surface_pressure != 0)
    domain.fail("surface_pressure", "is given", "the pressure of an ideal gas is absolute: remove it");
  if (scene.central_pull != 0)
    domain.fail("central_pull", "is given", "it is for liquids without walls: remove it");
  const auto refuse = [&](bool given, std::string_view key, std::string_view what, std::string_view right) {
    if (given) terms.fail(key, what, right);
  };
  refuse(scene.terms.density_diffusion != 0, "density_diffusion", "is given",
         "the density of an ideal gas is a sum over its neighbours: remove it");
  refuse(scene.terms.shifting, "shifting", "is on",
         "particles of an ideal gas are where their mass is: remove it");
  refuse(terms.has("viscosity") && scene.terms.viscosity != ViscosityForm::laplacian, "viscosity",
         "is \"symmetric\"", "beside an ideal gas it is \"laplacian\"");
  refuse(scene.terms.implicit_viscosity, "implicit_viscosity", "is on",
         "the heat of an ideal gas is that of explicit viscosity: remove it");
  refuse(scene.terms.pressure_weights != PressureWeights::volume, "pressure_weights", "is \"density\"",
         "an ideal gas has pressures of its own: remove it");
  refuse(terms.has("surface_tension"), "surface_tension", "is given", "gases have none: remove it");
}

}  // namespace sph
