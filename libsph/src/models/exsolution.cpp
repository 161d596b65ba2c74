#include "sph/models/exsolution.hpp"

#include <algorithm>
#include <cmath>

#include "pairs/for_rows.hpp"
#include "sph/core/exact_math.hpp"
#include "sph/laws/eos/bubbly.hpp"

namespace sph {
namespace {

/// (1 - exp(-x)) / x, 1 at 0.
double relaxed(double x) {
  constexpr double small = 1e-5;  // below it the series is exact to rounding
  return x < small ? 1 - 0.5 * x * (1 - x / 3) : (1 - exact_exp(-x)) / x;
}

/// w after a step.
double after(const Group& g, double m, double w, double pressure, double dt) {
  const double tau = g.bubbly.exsolution_time, wanted = dissolved_gas(g, m, pressure);
  if (tau == 0) return wanted;
  const bool free = pressure > 0 && wanted < m;  // else more pressure changes nothing
  const double follows =
      free ? g.bubbly.solubility_exponent * wanted / pressure * SlowBubblyEos(g, m, w).relief(pressure) : 0.0;
  return std::min(m, w) + (wanted - std::min(m, w)) * (dt / tau) * relaxed((1 + follows) * (dt / tau));
}

struct Exsolution {
  static constexpr FieldSet reads = Materials::reads;
  static constexpr FieldSet writes = Materials::writes | FieldSet{Field::dissolved_gas};
  const SphConstants* constants;
  const Materials* materials;

  void operator()(const View<reads, writes>& p, const Step& step) const {
    const auto* group = p.get<Field::group>();
    for (RowClass c : {RowClass::interior_movers, RowClass::boundary_movers}) {
      const RowRange& r = range_of(step.ranges, c);
      for (std::size_t i = r.first; i < r.last; ++i) {
        const Group& g = constants->scene->groups[group[i]];
        if (g.eos.law->kind != EosKind::bubbly) continue;
        double& w = p.get<Field::dissolved_gas>()[i];
        w = after(g, p.get<Field::gas_content>()[i], w,
                  p.get<Field::pressure>()[i] + materials->outer(p, i, g), step.global.dt);
      }
      materials->derive(p, r.first, r.last);  // as after a restart
    }
  }
};

}  // namespace

bool exsolves_slowly(const Scene& scene) {
  return std::ranges::any_of(scene.groups, [](const Group& g) { return g.bubbly.exsolution_time > 0; });
}

void add_exsolution(Builder& b) {
  b.add_fields({Field::dissolved_gas});
  b.add_kick("exsolution", Exsolution{&b.constants(), &b.materials()});
}

void start_exsolution(const SphConstants& constants, Particles& p) {
  double* w = p.data<Field::dissolved_gas>();
  for (std::size_t i = 0; w != nullptr && i < p.owned(); ++i) {
    const Group& g = constants.scene->groups[p.data<Field::group>()[i]];
    const double m = p.data<Field::gas_content>()[i];
    if (g.eos.law->kind != EosKind::bubbly || !(m > 0)) continue;
    w[i] = dissolved_gas(g, m, bubbly_eos(g, m).pressure(p.data<Field::density>()[i]));
  }
}

}  // namespace sph
