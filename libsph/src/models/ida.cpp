// The paper's cycle: velocity gradient (10), density (8), pressure, stress (9) or (11) of every particle,
// walls included; then the force (6) on those that move.
#include "sph/terms/ida.hpp"

#include "models/trace.hpp"
#include "sph/models/faults.hpp"
#include "sph/models/models.hpp"
#include "sph/models/stress_update.hpp"
#include "sph/terms/artificial_viscosity.hpp"

namespace sph {
namespace {

struct DensitiesAndStresses {
  static constexpr FieldSet reads = Materials::reads | RangeView::reads | FieldSet{Field::velocity_gradient};
  static constexpr FieldSet writes = Materials::writes | FieldSet{Field::density, Field::stress};
  const SphConstants* constants;
  const Materials* materials;

  void operator()(const View<reads, writes>& p, const Step& step) const {
    for (const RowRange& r : step.ranges) {
      update(p, r.first, r.last, step.global.dt);
      find_out_of_range(*constants, p, r.first, r.last, step);
    }
  }

  void update(const View<reads, writes>& p, std::size_t first, std::size_t last, double dt) const {
    const std::size_t d = static_cast<std::size_t>(p.dim()), n = d * (d + 1) / 2;
    const double* gradient = p.get<Field::velocity_gradient>();
    double* rho = p.get<Field::density>();
    double* stress = p.get<Field::stress>();
    const auto* group = p.get<Field::group>();
    for (std::size_t i = first; i < last; ++i) rho[i] -= dt * rho[i] * trace_of(gradient + i * d * d, d);
    materials->derive(p, first, last);
    for (std::size_t i = first; i < last; ++i) {
      const Group& g = constants->scene->groups[group[i]];
      double* s = stress + i * n;
      const double* grad = gradient + i * d * d;
      if (g.kind == GroupKind::solid) {
        // (11) less its isotropic part: -K div v is the rate of -p in (10), so lambda - K = -2/3 mu is left.
        if (d == 2)
          update_hooke_literal<2>(s, grad, -2.0 / 3.0 * g.solid.shear_modulus, g.solid.shear_modulus, dt);
        else
          update_hooke_literal<3>(s, grad, -2.0 / 3.0 * g.solid.shear_modulus, g.solid.shear_modulus, dt);
        continue;
      }
      const double div = trace_of(grad, d);
      for (std::size_t a = 0; a < d; ++a)
        for (std::size_t b = a; b < d; ++b) {
          const std::size_t k = a == b ? a : d + a + b - 1;
          s[k] =
              g.viscosity * (grad[a * d + b] + grad[b * d + a]) + (a == b ? g.viscosity_law.bulk * div : 0.0);
        }
    }
  }
};

}  // namespace

void add_ida(Builder& b) {
  b.add_sums("gradient", {term<IdaGradient>}, Builder::Rows::all);
  b.add_update("densities and stresses", DensitiesAndStresses{&b.constants(), &b.materials()});
  std::vector<Term> forces{term<IdaStress>};
  if (b.scene().terms.artificial_viscosity > 0) forces.push_back(term<ArtificialViscosity>);
  b.add_sums("forces", forces);
}

}  // namespace sph
