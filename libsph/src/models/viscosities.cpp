#include "sph/models/viscosities.hpp"

#include <algorithm>
#include <cmath>

#include "pairs/for_rows.hpp"
#include "sph/laws/enthalpy.hpp"
#include "sph/laws/eos/bubbly.hpp"
#include "sph/laws/melt_viscosity.hpp"
#include "sph/terms/wall.hpp"

namespace sph {
namespace {

struct OfMovers {
  static constexpr FieldSet reads = Viscosities::reads;
  static constexpr FieldSet writes = Viscosities::writes;
  const SphConstants* constants;
  Viscosities viscosities;

  void operator()(const View<reads, writes>& p, const Step& step) const {
    const double most = most_viscosity(*constants);
    double* eta = p.get<Field::viscosity>();
    for (RowClass c : {RowClass::interior_movers, RowClass::boundary_movers}) {
      const RowRange& r = range_of(step.ranges, c);
      step.maxima.viscosity = larger(viscosities.derive(p, r.first, r.last), step.maxima.viscosity);
      for (std::size_t i = r.first; i < r.last; ++i)
        if (!(eta[i] <= most))
          find_fault(*constants, p, i, step, "is too stiff to be a fluid; give viscosity_law.most");
    }
    for_walls(step.ranges, [&](std::size_t i) { eta[i] = 0; });  // until they are looked at
  }

  /// Its square is a number in single precision too, over h.
  static double most_viscosity(const SphConstants& k) { return 1e18 * k.scene->kernel.smoothing_length; }
};

struct OfWalls {
  static constexpr FieldSet reads{Field::wall_viscosity};
  static constexpr FieldSet writes{Field::viscosity};
  double h;  ///< over which rows have it

  void operator()(const View<reads, writes>& p, const Step& step) const {
    const double* sums = p.get<Field::wall_viscosity>();
    for_walls(step.ranges, [&](std::size_t i) {
      p.get<Field::viscosity>()[i] = sums[2 * i] > 0 ? h * (sums[2 * i + 1] / sums[2 * i]) : 0.0;
    });
  }
};

}  // namespace

bool has_viscosity_law(const Scene& scene) {
  return scene.terms.exchange.motion &&
         std::ranges::any_of(scene.groups, [](const Group& g) { return g.viscosity_law.varies(); });
}

double Viscosities::derive(const Particles& p, std::size_t first, std::size_t last) const {
  const double* rho = p.get<Field::density>();
  double* eta = p.get<Field::viscosity>();
  double fastest = 0;
  for (std::size_t i = first; i < last; ++i) {
    eta[i] = 0;
    if (constants_->is_wall(p.get<Field::group>()[i])) continue;
    eta[i] = of(p, i);
    fastest = larger(eta[i] / rho[i], fastest);
  }
  return fastest;
}

double Viscosities::of(const Particles& p, std::size_t i) const {
  const Scene& scene = *constants_->scene;
  const Group& g = scene.groups[p.get<Field::group>()[i]];
  if (!g.viscosity_law.varies()) return g.viscosity;
  MeltState s;
  if (g.viscosity_law.temperature) s.temperature = *g.viscosity_law.temperature;
  if (const double* t = p.get<Field::temperature>()) s.temperature = t[i];
  s.crystals = 1 - liquid_share(g.heat.material, s.temperature);
  if (const double* psi = p.get<Field::void_fraction>()) s.void_fraction = psi[i];
  if (g.viscosity_law.law == ViscosityLaw::hess_dingwell) {
    const double m = p.get<Field::gas_content>()[i];
    const double* w = p.get<Field::dissolved_gas>();
    const double dissolved =
        w != nullptr && g.bubbly.exsolution_time > 0
            ? std::fmin(m, w[i])
            : dissolved_gas(g, m, p.get<Field::pressure>()[i] + Materials(*constants_).outer(p, i, g));
    s.water = dissolved / (1 + dissolved);
  }
  return melt_viscosity(g, s);
}

void add_viscosities(Builder& b) {
  const Scene& s = b.scene();
  b.add_fields({Field::viscosity});
  b.add_update("viscosities", OfMovers{&b.constants(), Viscosities(b.constants())});
  if (s.terms.viscous.implicit || !s.has_kind(GroupKind::wall)) return;
  b.add_sums("viscosities beside walls", {term<WallViscosity>}, Builder::Rows::walls);
  b.add_update("viscosities of walls", OfWalls{s.kernel.smoothing_length});
}

}  // namespace sph
