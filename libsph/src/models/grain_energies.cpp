// Energies of grains. Those of their contacts are added by who lists contacts for output (contact_records.hpp).
#include "sph/models/grains.hpp"

namespace sph {
namespace {

/// r^2 m w^2 / 5, the inertia of a sphere being 2/5 m r^2.
double rotational_energy(const Particles& p, std::size_t row) {
  const double* w = p.data<Field::spin>() + row * 3;
  const double radius = p.data<Field::radius>()[row];
  double w2 = 0;
  for (std::size_t a = 0; a < 3; ++a) w2 += w[a] * w[a];
  return 0.2 * p.data<Field::mass>()[row] * (radius * radius) * w2;
}

}  // namespace

std::vector<Energy> Grains::energies() const {
  return {Energy::kinetic, Energy::rotational, Energy::potential, Energy::elastic};
}

void Grains::add_energies(const Particles& p, EnergySums& sums) const {
  const Wrap wrap = wrap_of(*scene_, scale_);
  for (std::size_t i = 0; i < p.owned(); ++i) {
    if (is_held(scene_->groups[p.data<Field::group>()[i]])) continue;
    sums[Energy::kinetic].add(kinetic_energy(p, i));
    sums[Energy::potential].add(potential_energy(*scene_, scale_, wrap, p, i));
    if (fusion_.spins) sums[Energy::rotational].add(rotational_energy(p, i));
  }
}

}  // namespace sph
