#include "sph/models/transitions.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "pairs/for_rows.hpp"
#include "sph/laws/enthalpy.hpp"
#include "sph/laws/eos/bubbly.hpp"
#include "sph/laws/eos/law.hpp"
#include "sph/models/faults.hpp"

namespace sph {
namespace {

bool same_state(const Group& a, const Group& b) {
  return a.eos == b.eos && a.density == b.density && a.bubbly.gas_rt == b.bubbly.gas_rt &&
         a.bubbly.solubility_pressure == b.bubbly.solubility_pressure &&
         a.bubbly.solubility_exponent == b.bubbly.solubility_exponent;
}

/// s:s / (4 mu) of the deviator, in two dimensions of plane strain [J/m^3].
double elastic_energy(const Group& g, const double* s, std::size_t d) {
  if (g.kind != GroupKind::solid) return 0;
  double trace = 0, sum = 0;
  for (std::size_t a = 0; a < d; ++a) {
    trace += s[a];
    sum += s[a] * s[a];
  }
  if (d == 2) sum += trace * trace;
  for (std::size_t k = d; k < d * (d + 1) / 2; ++k) sum += 2 * s[k] * s[k];
  return sum / (4 * g.solid.shear_modulus);
}

struct Transitions {
  static constexpr FieldSet reads =
      FaultView::reads | Materials::reads | FieldSet{Field::enthalpy, Field::mass};
  static constexpr FieldSet writes =
      Materials::writes | FieldSet{Field::group,        Field::density,        Field::stress,
                                   Field::temperature,  Field::liquid_mass,    Field::waiting_for,
                                   Field::waiting_time, Field::released_energy};
  using Rows = View<reads, writes>;
  const SphConstants* constants;
  const Materials* materials;

  void operator()(const Rows& p, const Step& step) const {
    const double *psi = p.get<Field::void_fraction>(), *t = p.get<Field::temperature>();
    for_movers(step.ranges, [&](std::size_t i) {
      const std::vector<Transition>& table = constants->scene->groups[p.get<Field::group>()[i]].becomes;
      const auto first = std::ranges::find_if(table, [&](const Transition& row) {
        return row.holds(psi != nullptr ? psi[i] : 0, t != nullptr ? t[i] : 0);
      });
      if (has_waited(p, i, first == table.end() ? nullptr : &*first,
                     static_cast<std::uint32_t>(first - table.begin()), step.global.dt))
        change(p, i, static_cast<std::uint32_t>(first->group), step);
    });
  }

  static bool has_waited(const Rows& p, std::size_t i, const Transition* row, std::uint32_t number,
                         double dt) {
    auto* waiting_for = p.get<Field::waiting_for>();
    double* time = p.get<Field::waiting_time>();
    if (waiting_for == nullptr) return row != nullptr;
    const bool goes_on = row != nullptr && waiting_for[i] == number + 1;
    time[i] = goes_on ? time[i] + dt : 0;
    waiting_for[i] = row != nullptr ? number + 1 : 0;
    if (row == nullptr || time[i] < row->hold) return false;
    waiting_for[i] = 0;
    time[i] = 0;
    return true;
  }

  void change(const Rows& p, std::size_t i, std::uint32_t to, const Step& step) const {
    const Scene& scene = *constants->scene;
    auto* group = p.get<Field::group>();
    const Group &old = scene.groups[group[i]], &now = scene.groups[to];
    const double mass = p.get<Field::mass>()[i];
    double& rho = p.get<Field::density>()[i];
    if (double* stress = p.get<Field::stress>()) release(p, i, old, now, stress, mass / rho);
    if (!same_state(old, now)) {
      const double* porosity = p.get<Field::porosity>();
      rho = density(p, i, now, step) * (porosity != nullptr ? porosity[i] : 1.0);
    }
    group[i] = to;
    const bool bubbly = now.eos.law->kind == EosKind::bubbly;
    if (double* psi = p.get<Field::void_fraction>()) psi[i] = 0;
    materials->derive(p, i, i + 1);  // as after a restart
    if (double* liquid = p.get<Field::liquid_mass>(); liquid != nullptr && bubbly && !(liquid[i] > 0))
      liquid[i] = mass / (1 + p.get<Field::gas_content>()[i]);
    if (const double* h = p.get<Field::enthalpy>())
      p.get<Field::temperature>()[i] = temperature(now.heat.material, h[i]);
  }

  void release(const Rows& p, std::size_t i, const Group& old, const Group& now, double* stress,
               double volume) const {
    const auto d = static_cast<std::size_t>(p.dim()), n = d * (d + 1) / 2;
    const double before = elastic_energy(old, stress + i * n, d);
    if (old.kind == GroupKind::solid && now.kind == GroupKind::fluid) std::fill_n(stress + i * n, n, 0.0);
    if (double* released = p.get<Field::released_energy>())
      released[i] += (before - elastic_energy(now, stress + i * n, d)) * volume;
  }

  /// Of the other matter at the pressure of this one; bubbly matter cannot be torn.
  [[nodiscard]] double density(const Rows& p, std::size_t i, const Group& now, const Step& step) const {
    const double surface = constants->scene->domain.surface_pressure, above = p.get<Field::pressure>()[i];
    if (now.eos.law->kind != EosKind::bubbly) return now.eos.law->start(now, above, surface).density;
    const double gas = p.get<Field::gas_content>()[i], absolute = above + surface;
    if (gas > 0 && !(absolute > 0) && !(surface > 0))
      find_fault(*constants, p, i, step,
                 "is torn where it becomes bubbly \"" + now.name + "\"; raise domain.surface_pressure");
    return bubbly_eos(now, gas).density(gas > 0 && !(absolute > 0) ? surface : absolute);
  }
};

}  // namespace

bool has_transitions(const Scene& scene) {
  return std::ranges::any_of(scene.groups, [](const Group& g) { return !g.becomes.empty(); });
}

bool has_released_energy(const Scene& scene) {
  return std::ranges::any_of(scene.groups,
                             [](const Group& g) { return g.kind == GroupKind::solid && !g.becomes.empty(); });
}

void add_transitions(Builder& b) {
  const bool waits = std::ranges::any_of(b.scene().groups, [](const Group& g) {
    return std::ranges::any_of(g.becomes, [](const Transition& row) { return row.hold > 0; });
  });
  if (waits) b.add_fields({Field::waiting_for, Field::waiting_time});
  if (has_released_energy(b.scene())) b.add_fields({Field::released_energy});
  b.add_kick("transitions", Transitions{&b.constants(), &b.materials()});
}

}  // namespace sph
