#include "output/energies.hpp"

#include "sph/laws/eos/law.hpp"

namespace sph {
bool is_held(const Group& group) { return group.kind == GroupKind::wall || group.grain.fixed; }

double elastic_energy(const Scene& scene, const ParticleValues& of, std::size_t row) {
  const Particles& p = of.particles();
  const auto d = static_cast<std::size_t>(p.dim());
  const Group& g = scene.groups[of.group(row)];
  if (g.kind == GroupKind::grain) return 0;  // in its contacts
  const double m = of.mass(row), rho = p.data<Field::density>()[row];
  const double* liquid = p.data<Field::liquid_density>();
  if (const double* strain = p.data<Field::strain_energy>()) return strain[row];
  double energy = m * (g.bulk_modulus / g.density) * g.eos->energy(g, liquid != nullptr ? liquid[row] : rho);
  if (g.kind != GroupKind::solid || scene.formulation != Formulation::conservative) return energy;
  const std::size_t n = d * (d + 1) / 2;
  const double* s = p.data<Field::stress>() + row * n;
  double product = d == 2 ? (s[0] + s[1]) * (s[0] + s[1]) : 0.0;  // of the zz component in plane strain
  for (std::size_t k = 0; k < n; ++k) product += (k < d ? 1.0 : 2.0) * (s[k] * s[k]);
  return energy + m / rho * product / (4 * g.shear_modulus);
}

double internal_energy(const ParticleValues& of, std::size_t row) {
  const double* u = of.particles().data<Field::specific_energy>();
  return u == nullptr ? 0.0 : of.mass(row) * u[row];
}

double kinetic_energy(const ParticleValues& of, std::size_t row) {
  double v2 = 0;
  for (int a = 0; a < of.particles().dim(); ++a) {
    const double v = of.velocity(row, static_cast<std::size_t>(a));
    v2 += v * v;
  }
  return 0.5 * of.mass(row) * v2;
}

double rotational_energy(const ParticleValues& of, std::size_t row) {
  const double* w = of.particles().data<Field::spin>();
  if (w == nullptr) return 0;
  const double radius = of.particles().data<Field::radius>()[row];
  double w2 = 0;
  for (std::size_t a = 0; a < 3; ++a) w2 += w[row * 3 + a] * w[row * 3 + a];
  return 0.2 * of.mass(row) * (radius * radius) * w2;  // I = 2/5 m r^2
}

double potential_energy(const Scene& scene, const ParticleValues& of, std::size_t row) {
  double work = 0;
  for (int axis = 0; axis < scene.dim; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    work += scene.gravity[a] * of.position(row, a);
    const double away = of.position(row, a) - scene.pull_centre[a];
    work -= 0.5 * scene.central_pull * (away * away);
  }
  return -of.mass(row) * work;
}

}  // namespace sph
