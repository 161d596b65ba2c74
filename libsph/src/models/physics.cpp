#include "sph/models/physics.hpp"

#include <algorithm>
#include <cmath>

#include "pairs/for_rows.hpp"
#include "sph/laws/eos/law.hpp"
#include "sph/models/models.hpp"
#include "start/start_sounds.hpp"

namespace sph {

Physics::Physics(std::size_t set, const Scene& scene, const PositionScale& scale)
    : Model(set),
      scene_(&scene),
      gas_(has_eos(scene, EosKind::ideal_gas)),
      constants_(scene, scale),
      materials_(constants_),
      body_forces_(constants_),
      builder_(constants_, materials_, body_forces_),
      steps_(constants_) {
  builder_.add_fields({Field::id, Field::position, Field::velocity, Field::density, Field::mass, Field::group,
                       Field::pressure, Field::force});
  if (has_eos(scene, EosKind::bubbly))
    builder_.add_fields({Field::sound_speed, Field::void_fraction, Field::gas_content});
  if (gas_) builder_.add_fields({Field::sound_speed, Field::specific_energy});
  stiffens_ = std::ranges::any_of(scene.groups, stiffens);
  if (stiffens_) builder_.add_fields({Field::sound_speed});
  if (scene.has_kind(GroupKind::solid) || scene.terms.formulation == Formulation::ida)
    builder_.add_fields({Field::stress});
  if (gas_) reach_.emplace(scene);
  if (scene.terms.shifting) shifting_.emplace(set, constants_, body_forces_);

  add_drift(builder_);
  if (scene.terms.formulation == Formulation::ida)
    add_ida(builder_);
  else if (gas_)
    add_gas(builder_);
  else if (scene.total_lagrangian())
    add_bonds(builder_);
  else
    add_liquids_and_solids();
  add_end_of_step();
}

void Physics::add_liquids_and_solids() {
  const Scene& s = *scene_;
  const bool walls = s.has_kind(GroupKind::wall), fluid = s.has_kind(GroupKind::fluid);
  // Grains in the fluid want to know of walls before it has densities, others after the forces.
  const bool wall_share = walls && fluid && (s.terms.viscous.implicit || s.start.has_surface || has_drag(s));
  if (wall_share && has_drag(s)) add_wall_share(builder_);
  add_kinematics(builder_);
  if (walls) add_walls(builder_, s.terms.pressure_weights == PressureWeights::density);
  const InterfaceTension& tension = s.terms.surface_tension;
  if (tension.coefficient > 0 && tension.form == TensionForm::jump) add_curvature(builder_);
  add_forces(builder_);
  add_accelerations(builder_);
  // Only where fluid flies can it come into walls.
  if (wall_share && !has_drag(s)) add_wall_share(builder_);
  if (wall_share && s.start.has_surface) add_walls_that_hold(builder_);
  if (s.terms.viscous.implicit) add_implicit_viscosity(builder_, walls);
}

void Physics::add_end_of_step() {
  const Scene& s = *scene_;
  add_kick(builder_);
  if (shifting_) shifting_->add_to(builder_);
  add_drifts(builder_);
  if (bulk_viscous(s)) add_pressures(builder_);
  if (std::ranges::any_of(s.groups, [](const Group& g) { return g.bubbly.fragments_to >= 0; }))
    add_fragmentation(builder_);
  if (shifting_) shifting_->add_motion_to(builder_);
  if (gas_) add_heat(builder_);
  if (stiffens_) add_sound(builder_);
  if (s.output.average_time > 0) add_averages(builder_);
}

// Wall particles do not move, but their pairs are taken with the velocity of their material.
double Physics::longest_look_back(const GlobalState& global) const {
  double wall2 = 0;
  for (const Group& g : scene_->groups) {
    double v2 = 0;
    for (double v : g.wall.velocity) v2 += v * v;
    wall2 = std::max(wall2, v2);
  }
  return 0.5 * std::max(longest_drift(global), 1.0001 * std::sqrt(wall2) * global.dt);
}

// Gases and solids fly at any Mach number; of liquids it says that they are meant to be stiffer.
double Physics::speed_limit() const {
  constexpr double light = 299'792'458, mach = 10;
  if (gas_ || !scene_->has_kind(GroupKind::fluid)) return light;
  return mach * *std::max_element(constants_.groups.sound_speed.begin(), constants_.groups.sound_speed.end());
}

}  // namespace sph
