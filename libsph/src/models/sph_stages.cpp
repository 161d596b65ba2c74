#include "sph/models/sph_stages.hpp"

#include <algorithm>

#include "sph/laws/eos/law.hpp"
#include "sph/models/exsolution.hpp"
#include "sph/models/failure.hpp"
#include "sph/models/models.hpp"
#include "sph/models/transitions.hpp"
#include "sph/models/viscosities.hpp"
#include "sph/terms/shifting.hpp"
#include "start/start_sounds.hpp"

namespace sph {
namespace {

void add_exchanges(Builder& b, const SphModels& m) {
  if (m.degassing) m.degassing->add_to(b);
  if (m.water) m.water->add_to(b);
  if (m.heat) m.heat->add_to(b);
}

void add_liquids_and_solids(Builder& b, SphModels& m) {
  const Scene& s = b.scene();
  const bool walls = s.has_kind(GroupKind::wall), fluid = s.has_kind(GroupKind::fluid);
  // Grains in the fluid and exchanges want to know of walls at once, others after the forces.
  const bool exchange = has_warm_walls(s) || has_open_walls(s) || (walls && s.terms.exchange.viscous_heat);
  const bool early = has_drag(s) || exchange;
  const bool wall_share =
      exchange || (walls && fluid && (s.terms.viscous.implicit || s.start.has_surface || has_drag(s)));
  if (has_wet_bodies(s)) add_bodies(b);
  if (wall_share && early) add_wall_share(b);
  add_kinematics(b);
  if (has_strength(s.groups)) add_strength(b);
  if (m.openings) m.openings->add_to(b);
  if (exchange) add_wall_slopes(b);
  if (has_viscosity_law(s)) add_viscosities(b);
  add_exchanges(b, m);
  if (bulk_viscous(s)) add_excess_pressures(b);
  if (has_wet_bodies(s))
    add_wet_sides(b);
  else if (walls)
    add_walls(b, s.terms.pressure_weights == PressureWeights::density);
  const InterfaceTension& tension = s.terms.surface_tension;
  if (tension.coefficient > 0 && tension.form == TensionForm::jump) add_curvature(b);
  add_forces(b);
  if (has_wet_bodies(s)) add_bond_forces(b);
  add_accelerations(b);
  // Only where fluid flies can it come into walls.
  if (wall_share && !early) add_wall_share(b);
  if (wall_share && s.start.has_surface) add_walls_that_hold(b);
  if (!s.terms.viscous.implicit) return;
  if (walls && !exchange) add_wall_slopes(b);
  add_implicit_viscosity(b);
}

void add_end_of_step(Builder& b, SphModels& m) {
  const Scene& s = b.scene();
  add_kick(b);
  if (m.shifting) m.shifting->add_to(b);
  add_drifts(b);
  // What a background bears depends on where a particle is.
  const bool moved = (m.shifting || has_drifts(s)) && s.domain.background.density > 0;
  if (moved || bulk_viscous(s)) add_pressures(b);
  if (exsolves_slowly(s)) add_exsolution(b);
  if (has_failure(s)) add_failure(b);
  if (has_transitions(s)) add_transitions(b);
  if (m.resets) m.resets->add_to(b);
  if (m.openings) m.openings->add_end_to(b);
  if (m.shifting) m.shifting->add_motion_to(b);
  if (has_eos(b.scene(), EosKind::ideal_gas)) add_heat(b);
  if (std::ranges::any_of(s.groups, stiffens)) add_sound(b);
  if (s.output.average_time > 0) add_averages(b);
}

void add_motion(Builder& b, SphModels& m) {
  add_drift(b);
  if (m.rigid) m.rigid->add_to(b);
  if (b.scene().terms.formulation == Formulation::ida)
    add_ida(b);
  else if (has_eos(b.scene(), EosKind::ideal_gas))
    add_gas(b);
  else if (has_dry_bodies(b.scene()))
    add_bodies(b);
  else
    add_liquids_and_solids(b, m);
  add_end_of_step(b, m);
}

void add_still_matter(Builder& b, SphModels& m) {
  if (has_warm_walls(b.scene()) || has_open_walls(b.scene())) {
    add_wall_share(b);
    add_wall_slopes(b);
  }
  if (has_escape(b.scene())) b.add_sums("concentration", {term<Concentration>});
  add_exchanges(b, m);
  if (exsolves_slowly(b.scene())) add_exsolution(b);
  if (has_transitions(b.scene())) add_transitions(b);
  if (m.resets) m.resets->add_to(b);
  if (b.scene().output.average_time > 0) add_averages(b);
}

}  // namespace

SphModels::SphModels(std::size_t set, const Builder& b) {
  const Scene& s = b.scene();
  if (s.terms.shifting && s.terms.exchange.motion) shifting.emplace(set, b.constants(), b.body_forces());
  if (s.has_gas_flow()) degassing.emplace(set, b.constants(), b.materials());
  if (s.has_water_diffusion()) water.emplace(set, b.constants(), b.materials());
  if (s.has_heat()) heat.emplace(set, b.constants());
  if (!s.domain.resets.empty()) resets.emplace(set, b.constants(), b.materials());
  if (has_rigid_bodies(s) && s.terms.exchange.motion) rigid.emplace(set, b.constants(), b.body_forces());
  if (s.domain.openings.any()) openings.emplace(set, b.constants(), b.materials());
}

std::vector<Model*> SphModels::all() {
  std::vector<Model*> out;
  if (shifting) out.push_back(&*shifting);
  if (degassing) out.push_back(&*degassing);
  if (water) out.push_back(&*water);
  if (heat) out.push_back(&*heat);
  if (resets) out.push_back(&*resets);
  return out;
}

void add_stages(Builder& b, SphModels& models) {
  if (b.scene().terms.exchange.motion)
    add_motion(b, models);
  else
    add_still_matter(b, models);
}

}  // namespace sph
