#include "sph/models/energies.hpp"

#include "sph/laws/background.hpp"
#include "sph/laws/eos/law.hpp"

namespace sph {

bool is_held(const Group& group) { return group.kind == GroupKind::wall || group.grain.fixed; }

double kinetic_energy(const Particles& p, std::size_t row) {
  const auto d = static_cast<std::size_t>(p.dim());
  const double* v = p.data<Field::velocity>() + row * d;
  double v2 = 0;
  for (std::size_t a = 0; a < d; ++a) v2 += v[a] * v[a];
  return 0.5 * p.data<Field::mass>()[row] * v2;
}

double compression_energy(const Group& g, double mass, double density) {
  return mass * (g.eos.bulk_modulus / g.density) * g.eos.law->energy(g, density);
}

double potential_energy(const Scene& scene, const PositionScale& scale, const Wrap& wrap, const Particles& p,
                        std::size_t row) {
  const auto d = static_cast<std::size_t>(p.dim());
  double work = 0;
  for (std::size_t a = 0; a < d; ++a) {
    const double x = scale.metres(wrap(static_cast<int>(a), p.data<Field::position>()[row * d + a]));
    const double away = x - scene.domain.pull_centre[a];
    work += scene.domain.gravity[a] * x;
    work -= 0.5 * scene.domain.central_pull * (away * away);
  }
  const double mass = p.data<Field::mass>()[row];
  if (!(scene.domain.background.density > 0)) return -mass * work;
  const Group& g = scene.groups[p.data<Field::group>()[row]];
  return -mass * weight_share(scene, g, p.data<Field::density>()[row]) * work;
}

}  // namespace sph
