#include "sph/models/materials.hpp"

#include <algorithm>

#include "sph/laws/eos/law.hpp"

namespace sph {

// Rows of one group in a row are one call of its law: particles that are near in space are near in memory.
template <class V>
void Materials::derive_into(const V& p, std::size_t first, std::size_t last) const {
  const Scene& scene = *constants_->scene;
  const auto* group = p.template get<Field::group>();
  EosRows rows{p.template get<Field::density>(),
               p.template get<Field::gas_content>(),
               p.template get<Field::specific_energy>(),
               p.template get<Field::pressure>(),
               nullptr,
               nullptr,
               scene.domain.surface_pressure};
  if (const double* liquid = p.template get<Field::liquid_density>()) rows.density = liquid;
  double* sound = nullptr;
  if constexpr (V::writes.has(Field::sound_speed)) {
    if (double* liquid = p.template get<Field::liquid_density>()) {
      const double* porosity = p.template get<Field::porosity>();
      const double* density = p.template get<Field::density>();
      for (std::size_t i = first; i < last; ++i) liquid[i] = density[i] / porosity[i];
    }
    sound = p.template get<Field::sound_speed>();
    rows.void_fraction = p.template get<Field::void_fraction>();
  }
  for (std::size_t begin = first, end; begin < last; begin = end) {
    end = begin + 1;
    while (end < last && group[end] == group[begin]) ++end;
    const Group& g = scene.groups[group[begin]];
    const bool wall = g.kind == GroupKind::wall && scene.terms.formulation == Formulation::conservative;
    rows.sound_speed = sound;
    if (sound != nullptr && (wall || g.eos.law->constant_sound)) {
      std::fill(sound + begin, sound + end, constants_->groups.sound_speed[group[begin]]);
      rows.sound_speed = nullptr;
    }
    if (wall) {  // until it is extrapolated from the fluid; a checkpoint does not have it
      std::fill(rows.pressure + begin, rows.pressure + end, 0.0);
      if (rows.void_fraction != nullptr) std::fill(rows.void_fraction + begin, rows.void_fraction + end, 0.0);
    } else {
      g.eos.law->derive(g, rows, begin, end);
    }
  }
}

void Materials::derive(const View<reads, writes>& p, std::size_t first, std::size_t last) const {
  derive_into(p, first, last);
}

void Materials::derive_pressure(const Pressures& p, std::size_t first, std::size_t last) const {
  derive_into(p, first, last);
}

}  // namespace sph
