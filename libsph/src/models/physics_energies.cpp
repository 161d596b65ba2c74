// Energies of fluids and solids (output/monitors.hpp has the formulas).
#include <algorithm>

#include "sph/models/energies.hpp"
#include "sph/models/physics.hpp"

namespace sph {
namespace {

/// Of compression, and of the deviator of stress in solids.
double elastic_energy(const Scene& scene, const Particles& p, std::size_t row) {
  const auto d = static_cast<std::size_t>(p.dim());
  const Group& g = scene.groups[p.data<Field::group>()[row]];
  if (const double* strain = p.data<Field::strain_energy>(); strain != nullptr && g.kind != GroupKind::fluid)
    return strain[row];
  const double m = p.data<Field::mass>()[row], rho = p.data<Field::density>()[row];
  const double* liquid = p.data<Field::liquid_density>();
  const double* e = p.data<Field::plastic_volume>();
  const double opened = e != nullptr ? 1 + e[row] : 1.0;
  double energy = compression_energy(g, m * opened, (liquid != nullptr ? liquid[row] : rho) * opened);
  if (g.kind != GroupKind::solid || scene.terms.formulation != Formulation::conservative) return energy;
  const std::size_t n = d * (d + 1) / 2;
  const double* s = p.data<Field::stress>() + row * n;
  double product = d == 2 ? (s[0] + s[1]) * (s[0] + s[1]) : 0.0;  // of the zz component in plane strain
  for (std::size_t k = 0; k < n; ++k) product += (k < d ? 1.0 : 2.0) * (s[k] * s[k]);
  return energy + m / rho * product / (4 * g.solid.shear_modulus);
}

}  // namespace

std::vector<Energy> Physics::energies() const {
  if (gas_) return {Energy::kinetic, Energy::potential, Energy::internal, Energy::elastic};
  if (has_strength(scene_->groups))
    return {Energy::kinetic, Energy::potential, Energy::elastic, Energy::plastic};
  return {Energy::kinetic, Energy::potential, Energy::elastic};
}

void Physics::add_energies(const Particles& p, EnergySums& sums) const {
  for (std::size_t i = 0; i < p.owned(); ++i) {
    const bool held = is_held(scene_->groups[p.data<Field::group>()[i]]);
    // Walls are strained by the solid that they hold, or by bodies that touch them.
    if (!held || scene_->total_lagrangian()) sums[Energy::elastic].add(elastic_energy(*scene_, p, i));
    if (held) continue;
    sums[Energy::kinetic].add(kinetic_energy(p, i));
    sums[Energy::potential].add(potential_energy(*scene_, constants_.scale, constants_.wrap, p, i));
    if (const double* work = p.data<Field::plastic_work>()) sums[Energy::plastic].add(work[i]);
    if (gas_) sums[Energy::internal].add(p.data<Field::mass>()[i] * p.data<Field::specific_energy>()[i]);
  }
}

}  // namespace sph
