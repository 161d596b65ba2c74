// The contact laws that are compiled in, and the sweep that a scene needs of them.
#include <algorithm>

#include "scene/keys/key_owners.hpp"
#include "sph/contact/hertz.hpp"
#include "sph/contact/linear.hpp"
#include "sph/contact/registry.hpp"
#include "sph/contact/walton_braun.hpp"
#include "sph/grains.hpp"
#include "sph/registry.hpp"

namespace sph {
namespace {

constexpr std::string_view contact_sort = "contact law";

/// A law that is not here, and that the program does not add, is none.
Registry<ContactLaw>& registry() {
  // The one thing in the library that outlives a scene: filled before the first is read, constant after it.
  static Registry<ContactLaw> laws(
      {&entry_of<LinearNormal>(), &entry_of<HertzNormal>(), &entry_of<WaltonBraun>()});
  return laws;
}

Roughness roughness_of(const Scene& scene) {
  bool friction = false, rolling = false;
  for (const Group& g : scene.groups) {
    friction = friction || g.grain.friction > 0;
    rolling = rolling || g.grain.rolling_friction > 0;
  }
  for (const ContactPair& p : scene.contact.pairs) {
    friction = friction || p.friction.value_or(0) > 0;
    rolling = rolling || p.rolling_friction.value_or(0) > 0;
  }
  return rolling ? Roughness::rolling : friction ? Roughness::sliding : Roughness::smooth;
}

}  // namespace

std::span<const ContactLaw* const> contact_laws() { return registry().look(); }

void register_contact_law(const ContactLaw& law) {
  keys::refuse_taken_keys({contact_sort, law.word, law.keys});
  registry().add(law);
}

std::vector<keys::KeyOwner> keys::contact_law_keys() {
  std::vector<KeyOwner> owners;
  for (const ContactLaw* law : registry().so_far()) owners.push_back({contact_sort, law->word, law->keys});
  return owners;
}

const ContactLaw& contact_law(const Scene& scene) {
  const ContactLaw& law = *scene.contact.law;
  return scene.contact.normal_damping ? *law.by_rate : law;
}

ContactFusion contact_fusion(const Scene& scene) {
  return contact_law(scene).fusion(roughness_of(scene), scene.groups.size() == 1);
}

FieldSet grain_fields(const Scene& scene) {
  FieldSet fields{Field::id, Field::position, Field::velocity, Field::mass, Field::group, Field::radius};
  if (contact_fusion(scene).spins) fields |= FieldSet{Field::spin};
  if (scene.output.average_time > 0) fields |= FieldSet{Field::velocity_mean};
  return fields;
}

}  // namespace sph
