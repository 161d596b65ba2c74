// [terms]: what acts between particles of fluids and solids.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "keys/scene_resolve.hpp"
#include "sph/laws/eos/law.hpp"
#include "sph/laws/melt_viscosity.hpp"

namespace sph {
namespace {

InterfaceTension read_surface_tension(const Reader<keys::surface_tension>& table,
                                      const std::vector<Group>& groups) {
  InterfaceTension tension;
  table.read(tension);
  for (const int k : tension.between)
    if (const Group& g = groups[static_cast<std::size_t>(k)]; g.kind != GroupKind::fluid)
      table.fail("between", fmt::format("names \"{}\", which is no fluid", g.name),
                 "name two groups of fluid, for example [\"melt\", \"gas\"]");
  if (tension.between[0] == tension.between[1])
    table.fail("between", "names one group twice",
               "name two groups of fluid, for example [\"melt\", \"gas\"]");
  const auto on_side = [&](std::size_t side, std::size_t k) {
    return can_become(groups, tension.between[side], static_cast<int>(k));
  };
  for (std::size_t k = 0; k < groups.size(); ++k)
    if (on_side(0, k) && on_side(1, k))
      table.fail("between", "names groups that become each other or the same one",
                 "what matter becomes stays on its side");
  for (std::size_t k = 0; k < groups.size(); ++k)
    if (tension.form == TensionForm::jump && groups[k].kind == GroupKind::fluid && !on_side(0, k) &&
        !on_side(1, k))
      table.fail("form", fmt::format("is \"jump\", and \"{}\" is a third fluid", groups[k].name),
                 "where three fluids meet no curvature says the jump: use \"stress\"");
  table.finish();
  return tension;
}

/// In spacings: bonds to the neighbours along the axes and the diagonals of a plane, so that few cross a crack.
constexpr double short_bonds = 1.9;

/// What holds by default, before the table says anything.
void set_usual_terms(Scene& scene) {
  const bool ida = scene.terms.formulation == Formulation::ida, total = has_dry_bodies(scene);
  const bool gas = has_eos(scene, EosKind::ideal_gas);
  Terms& terms = scene.terms;
  if (ida || total || gas) terms.density_diffusion = 0;
  if (has_failure(scene)) terms.bonds.reach = short_bonds;
  if (gas) {  // is rarely without shocks
    terms.artificial_viscosity = 1;
    terms.gas.quadratic_viscosity = 2;
    terms.gas.conduction = 0.3;
  }
  const auto counts = [&](const Group& g) {
    return g.kind != GroupKind::grain && !(has_wet_bodies(scene) && g.kind != GroupKind::fluid);
  };
  const auto first = std::ranges::find_if(scene.groups, counts);
  const bool uniform = std::ranges::all_of(scene.groups, [&](const Group& g) {
    return !counts(g) || (g.viscosity == first->viscosity && !g.viscosity_law.varies());
  });
  if (!(uniform || ida || total || gas)) terms.viscous.form = ViscosityForm::symmetric;
}

void check_terms(const TermsReader& table, const Scene& scene) {
  const Terms& terms = scene.terms;
  const double least = scene.terms.precision == Precision::mixed ? 1e-6 : 1e-12;
  if (terms.viscous.tolerance < least)
    table.fail("viscosity_tolerance", fmt::format("is {}", terms.viscous.tolerance),
               fmt::format("it is a share of the forces, {} to 0.1", least));
  const bool ida = scene.terms.formulation == Formulation::ida;
  if (ida && terms.density_diffusion != 0)
    table.fail("density_diffusion", fmt::format("is {}", terms.density_diffusion),
               "formulation = \"ida\" has none: remove it");
  if (ida && terms.shifting) table.fail("shifting", "is on", "formulation = \"ida\" has none: remove it");
  const auto refuse = [&](bool given, TermsReader::Name<> key) {
    if (has_dry_bodies(scene) && given)
      table.fail(key, "is of fluids and updated solids", "total-Lagrangian solids have none: remove it");
  };
  refuse(terms.density_diffusion != 0, "density_diffusion");
  refuse(terms.artificial_viscosity != 0, "artificial_viscosity");
  refuse(terms.shifting, "shifting");
  if (ida && scene.has_exchange())
    table.fail("motion", "is of a scene with heat, gas flow or diffusion of water",
               "formulation = \"ida\" has none: remove group.heat, group.permeability and "
               "group.water_diffusivity");
  if (!terms.exchange.motion && !scene.has_exchange())
    table.fail("motion", "is false",
               "without group.heat, group.permeability or group.water_diffusivity nothing would happen");
  if (terms.exchange.viscous_heat && !scene.has_heat())
    table.fail("viscous_heat", "is on", "without group.heat it would warm nothing");
  if (terms.exchange.viscous_heat && !terms.exchange.motion)
    table.fail("viscous_heat", "is on", "with motion = false nothing rubs");
  if (terms.exchange.implicit_conduction && !scene.has_heat())
    table.fail("implicit_conduction", "is on", "without group.heat nothing conducts");
  if (terms.exchange.implicit_gas_flow && !scene.has_gas_flow())
    table.fail("implicit_gas_flow", "is on", "without group.permeability no gas flows");
  if (ida && std::ranges::any_of(scene.groups, [](const Group& g) { return g.viscosity_law.varies(); }))
    table.fail("motion", "is of a scene with a viscosity law", "formulation = \"ida\" has none: remove it");
  for (const Group& g : scene.groups)
    for (const Transition& row : g.becomes)
      if (ida && scene.groups[static_cast<std::size_t>(row.group)].kind != g.kind)
        table.fail("motion", fmt::format("is of a scene in which \"{}\" freezes or melts", g.name),
                   "formulation = \"ida\" has fragmentation alone");
  if (!terms.exchange.motion && scene.is_mixture())
    table.fail("motion", "is false", "grains move: remove it");
}

}  // namespace

void read_terms(const TermsReader& table, Scene& scene) {
  set_usual_terms(scene);
  table.read(scene.terms);
  table.only_if(scene.terms.viscous.implicit, "viscosity_tolerance", "set implicit_viscosity = true too");
  table.only_if(scene.terms.exchange.implicit_conduction || scene.terms.exchange.implicit_gas_flow,
                "exchange_tolerance", "set implicit_conduction or implicit_gas_flow = true too");
  check_terms(table, scene);
  if (table.has("surface_tension"))
    scene.terms.surface_tension = read_surface_tension(table.table<keys::surface_tension>(), scene.groups);
  read_added_terms(table, scene.terms);
  table.finish();
}

// Gas that flows does, as soon as it does: that is looked at in a run.
void check_still_step(const TermsReader& terms, const Scene& scene) {
  const ExchangeTerms& exchange = scene.terms.exchange;
  if (exchange.motion || scene.has_gas_flow() || scene.has_water_diffusion() || scene.time.dt) return;
  if (exchange.implicit_conduction)
    terms.fail("implicit_conduction", "is on, and nothing else limits the time step", "give time.dt");
  if (std::ranges::none_of(scene.groups, [](const Group& g) { return g.heat.material.conductivity > 0; }))
    terms.fail("motion", "is false, no group conducts, and nothing limits the time step", "give time.dt");
}

// Rounding of the operator in single precision shows in the momentum: 1e-4 of it at 1e6, 1e-3 at 1e7. Fluid
// beside a wall that slips would lack the viscosity of what is mirrored there.
void check_implicit_viscosity(const TermsReader& terms, const Scene& scene) {
  constexpr double most = 1e5;
  if (!scene.terms.viscous.implicit) return;
  for (const Group& g : scene.groups)
    if (g.wall.slip)
      terms.fail("implicit_viscosity", fmt::format("is on, and the wall \"{}\" slips", g.name),
                 "it knows walls that do not slip alone");
  if (scene.terms.precision != Precision::mixed) return;
  double diffusivity = 0, sound = 0;
  for (const Group& g : scene.groups) {
    const double eta = g.viscosity_law.varies() ? viscosity_at_start(g) : g.viscosity;
    diffusivity = std::max(diffusivity, eta / g.density);
    sound = std::max(sound, std::sqrt(g.eos.bulk_modulus / g.density));
  }
  const double h = scene.kernel.smoothing_length, dt = scene.time.dt.value_or(scene.time.cfl * h / sound);
  if (const double number = diffusivity * dt / (h * h); number > most)
    terms.fail("implicit_viscosity", fmt::format("in mixed precision with nu dt / h^2 = {:.3g}", number),
               fmt::format("set precision = \"double\" above {:.3g}", most));
}

}  // namespace sph
