// The contact laws that are compiled in, and the sweep that a scene needs of them.
#include <algorithm>

#include "laws/registries.hpp"
#include "sph/laws/contact/hertz.hpp"
#include "sph/laws/contact/linear.hpp"
#include "sph/laws/contact/registry.hpp"
#include "sph/laws/contact/walton_braun.hpp"

namespace sph {
namespace {

Roughness roughness_of(const Scene& scene) {
  bool friction = false, rolling = false;
  for (const Group& g : scene.groups) {
    friction = friction || g.grain.friction > 0;
    rolling = rolling || g.grain.rolling_friction > 0;
  }
  for (const ContactPair& p : scene.grains.contact.pairs) {
    friction = friction || p.friction.value_or(0) > 0;
    rolling = rolling || p.rolling_friction.value_or(0) > 0;
  }
  return rolling ? Roughness::rolling : friction ? Roughness::sliding : Roughness::smooth;
}

}  // namespace

/// A law that is not here, and that the program does not add, is none.
Registry<ContactLaw>& contact_law_registry() {
  // The one thing in the library that outlives a scene: filled before the first is read, constant after it.
  static Registry<ContactLaw> laws(
      {&entry_of<LinearNormal>(), &entry_of<HertzNormal>(), &entry_of<WaltonBraun>()});
  return laws;
}

std::span<const ContactLaw* const> contact_laws() { return contact_law_registry().look(); }

const ContactLaw& contact_law(const Scene& scene) {
  const ContactLaw& law = *scene.grains.contact.law;
  return scene.grains.contact.normal_damping ? *law.by_rate : law;
}

ContactFusion contact_fusion(const Scene& scene) {
  return contact_law(scene).fusion(roughness_of(scene), scene.groups.size() == 1);
}

}  // namespace sph
