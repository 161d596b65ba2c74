#include "sph/models/materials.hpp"

#include <algorithm>

#include "sph/laws/background.hpp"
#include "sph/laws/eos/bubbly.hpp"
#include "sph/laws/eos/law.hpp"

namespace sph {

// What has yielded fills more than its pressure knows of.
template <class V>
void derive_plastic(const V& p, const Group& g, EosRows rows, std::size_t begin, std::size_t end) {
  const double *rho = rows.density, *e = p.template get<Field::plastic_volume>();
  double* pressure = rows.pressure;
  double felt = 0;
  rows.density = &felt;
  rows.sound_speed = rows.void_fraction = nullptr;
  for (std::size_t i = begin; i < end; ++i) {
    felt = rho[i] * (1 + e[i]);
    rows.pressure = pressure + i;
    g.eos.law->derive(g, rows, 0, 1);
  }
}

// Rows of one group in a row are one call of its law: particles that are near in space are near in memory.
template <class V>
void Materials::derive_into(const V& p, std::size_t first, std::size_t last) const {
  const Scene& scene = *constants_->scene;
  const auto* group = p.template get<Field::group>();
  EosRows rows{p.template get<Field::density>(),
               p.template get<Field::gas_content>(),
               p.template get<Field::specific_energy>(),
               p.template get<Field::dissolved_gas>(),
               p.template get<Field::pressure>(),
               nullptr,
               nullptr,
               0};
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
    if (is_bonded(g)) continue;  // of its stress
    if (wall || is_rigid(g)) {   // until it is extrapolated from the fluid; a checkpoint does not have it
      std::fill(rows.pressure + begin, rows.pressure + end, 0.0);
      if (rows.void_fraction != nullptr) std::fill(rows.void_fraction + begin, rows.void_fraction + end, 0.0);
    } else {
      const bool excess = scene.domain.background.density > 0;
      rows.surface_pressure = excess ? 0.0 : scene.domain.surface_pressure;
      g.eos.law->derive(g, rows, begin, end);
      if (g.solid.strength && p.template get<Field::plastic_volume>() != nullptr)  // it moves
        derive_plastic(p, g, rows, begin, end);
      for (std::size_t i = begin; excess && i < end; ++i) rows.pressure[i] -= outer(p, i, g);
    }
  }
}

double Materials::outer(const Placed& p, std::size_t i, const Group& group) const {
  const Scene& scene = *constants_->scene;
  Double3 x{};
  const auto d = static_cast<std::size_t>(p.dim());
  for (std::size_t a = 0; a < d; ++a) x[a] = constants_->scale.metres(p.get<Field::position>()[i * d + a]);
  return outer_pressure(scene, group, x);
}

// Bubbly matter cannot be torn.
double Materials::density_of(const AtPressure& p, std::size_t i, const Group& group, double gas_content,
                             const Step& step) const {
  const double* porosity = p.get<Field::porosity>();
  const double share = porosity != nullptr ? porosity[i] : 1.0;
  const double outside = outer(p, i, group), above = p.get<Field::pressure>()[i], all = above + outside;
  if (group.eos.law->kind != EosKind::bubbly)
    return group.eos.law->start(group, above, outside).density * share;
  const bool slow = group.bubbly.exsolution_time > 0;
  const double* dissolved = p.get<Field::dissolved_gas>();
  const bool torn = gas_content > (slow ? dissolved[i] : 0.0) && !(all > 0);
  if (torn && !(outside > 0))
    find_fault(*constants_, p, i, step,
               "is torn where it becomes bubbly \"" + group.name + "\"; raise domain.surface_pressure");
  const double at = torn ? outside : all;
  return share * (slow ? SlowBubblyEos(group, gas_content, dissolved[i]).density(at)
                       : bubbly_eos(group, gas_content).density(at));
}

void Materials::derive(const View<reads, writes>& p, std::size_t first, std::size_t last) const {
  derive_into(p, first, last);
}

void Materials::derive_pressure(const Pressures& p, std::size_t first, std::size_t last) const {
  derive_into(p, first, last);
}

}  // namespace sph
