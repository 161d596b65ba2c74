#include "sph/models/transitions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "models/crack_plane.hpp"
#include "pairs/for_rows.hpp"
#include "sph/laws/enthalpy.hpp"
#include "sph/laws/eos/bubbly.hpp"
#include "sph/laws/eos/law.hpp"
#include "sph/models/energies.hpp"

namespace sph {
namespace {

bool same_state(const Group& a, const Group& b) {
  return a.eos == b.eos && a.density == b.density && a.bubbly.gas_rt == b.bubbly.gas_rt &&
         a.bubbly.solubility_pressure == b.bubbly.solubility_pressure &&
         a.bubbly.solubility_exponent == b.bubbly.solubility_exponent &&
         (a.bubbly.exsolution_time > 0) == (b.bubbly.exsolution_time > 0);
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
  static constexpr FieldSet reads = FaultView::reads | RangeView::reads | Materials::reads |
                                    FieldSet{Field::enthalpy,      Field::failing, Field::wet_pressure,
                                             Field::strain_energy, Field::crack,   Field::prestress};
  static constexpr FieldSet writes = Materials::writes |
                                     FieldSet{Field::plastic_volume, Field::plastic_strain, Field::opening} |
                                     FieldSet{Field::group,
                                              Field::density,
                                              Field::mass,
                                              Field::stress,
                                              Field::temperature,
                                              Field::liquid_mass,
                                              Field::waiting_for,
                                              Field::waiting_time,
                                              Field::released_energy,
                                              Field::mass_inflow,
                                              Field::void_fraction_mean,
                                              Field::temperature_mean,
                                              Field::pressure};
  using Rows = View<reads, writes>;
  const SphConstants* constants;
  const Materials* materials;

  void operator()(const Rows& p, const Step& step) const {
    const double *psi = p.get<Field::void_fraction>(), *t = p.get<Field::temperature>();
    const double *psi_mean = p.get<Field::void_fraction_mean>(), *t_mean = p.get<Field::temperature_mean>();
    const auto of = [](const double* now, const double* mean, const Transition& row, std::size_t i) {
      const double* value = row.average > 0 ? mean : now;
      return value != nullptr ? value[i] : 0.0;
    };
    for_movers(step.ranges, [&](std::size_t i) {
      const std::vector<Transition>& table = constants->scene->groups[p.get<Field::group>()[i]].becomes;
      for (const Transition& row : table) {
        if (!row.of_mean() || &row != &first_mean(table, row)) continue;
        row.of_temperature()
            ? follow(p.get<Field::temperature_mean>()[i], t[i], row.average, step.global)
            : follow(p.get<Field::void_fraction_mean>()[i], psi[i], row.average, step.global);
      }
      const auto first = std::ranges::find_if(table, [&](const Transition& row) {
        return row.of_failure() ? p.get<Field::failing>()[i] == 1
                                : row.holds(of(psi, psi_mean, row, i), of(t, t_mean, row, i));
      });
      if (has_waited(p, i, first == table.end() ? nullptr : &*first,
                     static_cast<std::uint32_t>(first - table.begin()), step.global.dt))
        change(p, i, *first, step);
    });
  }

  /// The first row with a mean of the same quantity.
  static const Transition& first_mean(const std::vector<Transition>& table, const Transition& row) {
    return *std::ranges::find_if(table, [&](const Transition& other) {
      return other.of_mean() && other.of_temperature() == row.of_temperature();
    });
  }

  /// a += dt/T (f - a), T the time since the start until that is the window.
  static void follow(double& mean, double value, double window, const GlobalState& global) {
    mean += std::fmin(global.dt / std::fmin(window, global.time + global.dt), 1.0) * (value - mean);
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

  void change(const Rows& p, std::size_t i, const Transition& row, const Step& step) const {
    const Scene& scene = *constants->scene;
    const auto to = static_cast<std::uint32_t>(row.group);
    auto* group = p.get<Field::group>();
    const Group &old = scene.groups[group[i]], &now = scene.groups[to];
    double& mass = p.get<Field::mass>()[i];
    double& rho = p.get<Field::density>()[i];
    const bool bubbly = now.eos.law->kind == EosKind::bubbly;
    if (const double* gas = p.get<Field::gas_content>(); bubbly && gas != nullptr && !can_hold(now, gas[i])) {
      find_fault(
          *constants, p, i, step,
          fmt::format("has a gas content of {:.3g}, too much for \"{}\" which it becomes: of it the densest "
                      "gas is denser than the liquid; check the solubility",
                      gas[i], now.name));
      return;
    }
    const double volume = mass / rho;
    if (is_bonded(old) && row.keeps == Conserved::both) rho /= 1 + widening(p, i, old);
    if (double* stress = p.get<Field::stress>()) release(p, i, old, now, stress, volume);
    double* opened = p.get<Field::plastic_volume>();
    // What fails has the pressure of the fluid beside it, or that it was under itself.
    const bool jumps = is_bonded(old) && row.keeps == Conserved::both;
    if (is_bonded(old)) {
      double& pressure = p.get<Field::pressure>()[i];
      const double wet = p.get<Field::wet_pressure>()[i];
      pressure = wet != 0 ? wet : std::fmax(pressure, 0.0);
    }
    if (!jumps && (is_bonded(old) || !same_state(old, now) || (opened != nullptr && opened[i] != 0))) {
      const double* gas = p.get<Field::gas_content>();
      const double before = rho;
      rho = materials->density_of(p, i, now, gas != nullptr ? gas[i] : 0.0, step);
      if (row.keeps == Conserved::volume) swell(p, i, rho / before);
    }
    // What was stored in bonds but for what the fluid's pressure stores.
    if (double* released = p.get<Field::released_energy>(); released != nullptr && is_bonded(old))
      released[i] -= compression_energy(now, mass, rho);
    group[i] = to;
    if (opened != nullptr)
      opened[i] = p.get<Field::opening>()[i] = p.get<Field::plastic_strain>()[i] =
          0;  // the density is that of the pressure now, and nothing is left of shear bands
    if (double* psi = p.get<Field::void_fraction>()) psi[i] = 0;
    materials->derive(p, i, i + 1);  // as after a restart
    // Here, or pairs spread what is no number as far as lists reach, and messages name whom they find.
    find_out_of_range(*constants, p, i, i + 1, step);
    if (double* liquid = p.get<Field::liquid_mass>(); liquid != nullptr && bubbly && !(liquid[i] > 0))
      liquid[i] = mass / (1 + p.get<Field::gas_content>()[i]);
    if (const double* h = p.get<Field::enthalpy>())
      p.get<Field::temperature>()[i] = temperature(now.heat.material, h[i]);
    if (double* mean = p.get<Field::void_fraction_mean>()) mean[i] = p.get<Field::void_fraction>()[i];
    if (double* mean = p.get<Field::temperature_mean>()) mean[i] = p.get<Field::temperature>()[i];
  }

  /// Of what fails: the faces beside it, half a spacing of rock each, are as strained across the crack as it is itself, and come
  /// back once it bears nothing: the space that it leaves is so much wider.
  static double widening(const Rows& p, std::size_t i, const Group& rock) {
    const auto d = static_cast<std::size_t>(p.dim());
    CrackPlane plane;
    std::copy_n(p.get<Field::crack>() + i * d, d, plane.normal.begin());
    const double before = p.get<Field::prestress>() != nullptr ? p.get<Field::prestress>()[i] : 0.0;
    return std::fmax(0.0,
                     strain_across(plane, in_space(p.get<Field::stress>() + i * (d * (d + 1) / 2), p.dim()),
                                   p.get<Field::pressure>()[i] - before, rock));
  }

  /// Gives a body's particle, without gas and heat, so many times its mass.
  static void swell(const Rows& p, std::size_t i, double factor) {
    double& mass = p.get<Field::mass>()[i];
    const double before = mass;
    mass *= factor;
    p.get<Field::mass_inflow>()[i] += mass - before;
  }

  void release(const Rows& p, std::size_t i, const Group& old, const Group& now, double* stress,
               double volume) const {
    const auto d = static_cast<std::size_t>(p.dim()), n = d * (d + 1) / 2;
    const bool bonded = is_bonded(old);
    const double before =
        bonded ? p.get<Field::strain_energy>()[i] / volume : elastic_energy(old, stress + i * n, d);
    if (old.kind == GroupKind::solid && now.kind == GroupKind::fluid) std::fill_n(stress + i * n, n, 0.0);
    if (double* released = p.get<Field::released_energy>())
      released[i] += (before - elastic_energy(now, stress + i * n, d)) * volume;
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
  for (const Group& g : b.scene().groups)
    for (const Transition& row : g.becomes)
      if (row.of_mean())
        b.add_fields({row.of_temperature() ? Field::temperature_mean : Field::void_fraction_mean});
  for (const Group& g : b.scene().groups)
    if (std::ranges::any_of(g.becomes, [](const Transition& row) { return row.keeps == Conserved::volume; }))
      b.add_fields({Field::mass_inflow});
  if (has_released_energy(b.scene())) b.add_fields({Field::released_energy});
  b.add_kick("transitions", Transitions{&b.constants(), &b.materials()});
}

}  // namespace sph
