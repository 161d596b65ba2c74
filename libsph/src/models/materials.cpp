#include "sph/models/materials.hpp"

namespace sph {

template <class V>
void Materials::derive_into(const V& p, std::size_t first, std::size_t last) const {
  const Scene& scene = *constants_->scene;
  const double* rho = p.template get<Field::density>();
  const auto* group = p.template get<Field::group>();
  double* pressure = p.template get<Field::pressure>();
  double *sound = nullptr, *psi = nullptr;
  if constexpr (V::writes.has(Field::sound_speed)) {
    sound = p.template get<Field::sound_speed>();
    psi = p.template get<Field::void_fraction>();
  }
  const double* gas = p.template get<Field::gas_content>();
  const double* energy = p.template get<Field::specific_energy>();
  for (std::size_t i = first; i < last; ++i) {
    const Group& g = scene.groups[group[i]];
    if (g.kind == GroupKind::wall && scene.formulation == Formulation::conservative) {
      if (sound != nullptr) sound[i] = constants_->groups.sound_speed[group[i]];
      if (psi != nullptr) psi[i] = 0;
      pressure[i] = 0;  // until it is extrapolated from the fluid; a checkpoint does not have it
      continue;
    }
    double absolute, c = constants_->groups.sound_speed[group[i]], void_fraction = 0;
    if (g.eos == EosKind::bubbly) {
      const BubblyEos eos = gas[i] == g.gas_content ? constants_->bubbly[group[i]] : bubbly_eos(g, gas[i]);
      absolute = eos.pressure(rho[i]);
      c = eos.sound_speed(absolute);
      void_fraction = eos.void_fraction(absolute);
    } else if (g.eos == EosKind::ideal_gas) {
      const IdealGas eos{g.heat_ratio};
      absolute = eos.pressure(rho[i], energy[i]);
      c = eos.sound_speed(energy[i]);
    } else {
      absolute = g.bulk_modulus * ((rho[i] - g.density) / g.density);
    }
    pressure[i] = absolute - scene.surface_pressure;
    if (sound != nullptr) sound[i] = c;
    if (psi != nullptr) psi[i] = void_fraction;
  }
}

void Materials::derive(const View<reads, writes>& p, std::size_t first, std::size_t last) const {
  derive_into(p, first, last);
}

void Materials::derive_pressure(const Pressures& p, std::size_t first, std::size_t last) const {
  derive_into(p, first, last);
}

}  // namespace sph
