// From a law's struct (laws/contact/law.hpp) to its entry in the list that contact.law is looked up in. A program
// adds laws of its own before it reads its first scene: sph::register_contact_law<MyLaw>(). Including this
// header compiles the sweeps of the laws that are named to it.
#pragma once

#include <type_traits>

#include "sph/laws/contact/law.hpp"
#include "sph/pairs/contact_pass.hpp"

namespace sph {

template <class Law>
struct LawEntry {
  template <class Friction, class Rolling>
  static ContactFusion fuse(bool one_material) {
    using One = ContactPass<Law, Friction, Rolling, true>;
    using Several = ContactPass<Law, Friction, Rolling, false>;
    return {one_material ? One::run : Several::run, One::history, One::spins, One::parities};
  }
  static ContactFusion fusion(Roughness roughness, bool one_material) {
    if (roughness == Roughness::rolling) return fuse<Coulomb, RollingSpring>(one_material);
    if (roughness == Roughness::sliding) return fuse<Coulomb, NoRolling>(one_material);
    return fuse<NoFriction, NoRolling>(one_material);
  }
  /// Its answer to one contact, the history as it stands before.
  static PointForce respond(const PointContact& point, std::span<const double, 8> constants,
                            const double* history) {
    using V = Simd<double>;
    V row[8], memory[Law::history.size() + 1];
    for (std::size_t n = 0; n < 8; ++n) row[n] = constants[n];
    for (std::size_t n = 0; n < Law::history.size(); ++n) memory[n] = history[n];
    const auto k = ContactConstants<V>::of_row(row, V::zero());
    Contact<V> c{};
    c.overlap = point.overlap;
    c.separation = point.separation;
    c.radius = point.radius;
    c.mass = point.mass;
    c.dt = point.dt;
    const NormalForce<V> f = normal_force<Law>(c, k, memory);
    return {f.elastic[0], f.shear_stiffness[0], f.shear_change[0], Law::rolling_change(c, k, f, memory)[0],
            Law::energy(c, k, f)[0]};
  }
};

template <class Law>
const ContactLaw& entry_of() {
  static_assert(Law::keys.size() <= most_law_keys && Law::history.size() <= most_history);
  const ContactLaw* by_rate = nullptr;
  if constexpr (!std::is_void_v<typename Law::ByRate>) by_rate = &entry_of<typename Law::ByRate>();
  static const ContactLaw entry{Law::word,
                                Law::name,
                                Law::keys,
                                Law::dashpot,
                                by_rate,
                                Law::history,
                                Law::constants,
                                Law::stiffness,
                                Law::shear_stiffness,
                                Law::damping_share,
                                Law::steps,
                                LawEntry<Law>::respond,
                                LawEntry<Law>::fusion};
  return entry;
}

template <class Law>
void register_contact_law() {
  register_contact_law(entry_of<Law>());
}

}  // namespace sph
