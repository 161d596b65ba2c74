// The explicit list of compiled contact sweeps: a law that is not here is not compiled.
#include <algorithm>

#include "sph/contact_pass.hpp"
#include "sph/grains.hpp"

namespace sph {
namespace {

template <class Normal, class Friction, class Rolling>
ContactFusion fuse(bool one_material) {
  using One = ContactPass<Normal, Friction, Rolling, true>;
  using Several = ContactPass<Normal, Friction, Rolling, false>;
  return {one_material ? One::run : Several::run, One::history, One::spins};
}

template <class Normal>
ContactFusion with_friction(const Scene& scene, bool one_material) {
  bool friction = false, rolling = false;
  for (const Group& g : scene.groups) {
    friction = friction || g.grain.friction > 0;
    rolling = rolling || g.grain.rolling_friction > 0;
  }
  for (const ContactPair& p : scene.contact.pairs) {
    friction = friction || p.friction.value_or(0) > 0;
    rolling = rolling || p.rolling_friction.value_or(0) > 0;
  }
  if (rolling) return fuse<Normal, Coulomb, RollingSpring>(one_material);
  if (friction) return fuse<Normal, Coulomb, NoRolling>(one_material);
  return fuse<Normal, NoFriction, NoRolling>(one_material);
}

}  // namespace

ContactFusion contact_fusion(const Scene& scene) {
  const bool one_material = scene.groups.size() == 1;
  if (scene.contact.law == ContactLaw::hertz) return with_friction<HertzNormal>(scene, one_material);
  if (scene.contact.normal_damping) return with_friction<LinearRate>(scene, one_material);
  return with_friction<LinearNormal>(scene, one_material);
}

FieldSet grain_fields(const Scene& scene) {
  FieldSet fields{Field::id, Field::position, Field::velocity, Field::mass, Field::group, Field::radius};
  if (contact_fusion(scene).spins) fields |= FieldSet{Field::spin};
  if (scene.output.average_time > 0) fields |= FieldSet{Field::velocity_mean};
  return fields;
}

}  // namespace sph
