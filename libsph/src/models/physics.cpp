#include "sph/models/physics.hpp"

#include <algorithm>
#include <cmath>

#include "pairs/for_rows.hpp"
#include "sph/laws/eos/law.hpp"
#include "sph/models/models.hpp"
#include "sph/models/viscosities.hpp"
#include "start/start_sounds.hpp"

namespace sph {

Physics::Physics(std::size_t set, const Scene& scene, const PositionScale& scale)
    : Model(set),
      scene_(&scene),
      gas_(has_eos(scene, EosKind::ideal_gas)),
      bubbly_(has_eos(scene, EosKind::bubbly)),
      constants_(scene, scale),
      materials_(constants_),
      body_forces_(constants_),
      builder_(constants_, materials_, body_forces_),
      models_(set, builder_),
      steps_(constants_) {
  builder_.add_fields({Field::id, Field::position, Field::velocity, Field::density, Field::mass, Field::group,
                       Field::pressure, Field::force});
  if (has_eos(scene, EosKind::bubbly))
    builder_.add_fields({Field::sound_speed, Field::void_fraction, Field::gas_content});
  if (gas_) builder_.add_fields({Field::sound_speed, Field::specific_energy});
  stiffens_ = std::ranges::any_of(scene.groups, stiffens);
  if (stiffens_) builder_.add_fields({Field::sound_speed});
  const auto is_strained = [](const Group& g) { return g.kind == GroupKind::solid && !is_rigid(g); };
  if (std::ranges::any_of(scene.groups, is_strained) || scene.terms.formulation == Formulation::ida)
    builder_.add_fields({Field::stress});
  if (has_wet_bodies(scene)) builder_.add_fields({Field::acceleration});
  if (has_wet_bodies(scene) && has_bonds(scene)) builder_.add_fields({Field::prestress});
  if (gas_) reach_.emplace(scene);
  add_stages(builder_, models_);
}

void Physics::derive(Particles& p) const {
  materials_.derive(ViewOf<Materials>(p), 0, p.owned());
  if (has_viscosity_law(*scene_)) (void)Viscosities(constants_).derive(ViewOf<Viscosities>(p), 0, p.owned());
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
