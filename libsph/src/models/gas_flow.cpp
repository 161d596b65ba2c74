#include "sph/models/gas_flow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "models/gas_contents.hpp"
#include "models/gas_flow_solver.hpp"
#include "pairs/for_rows.hpp"
#include "sph/laws/eos/bubbly.hpp"
#include "sph/laws/permeability.hpp"
#include "sph/models/faults.hpp"
#include "sph/models/models.hpp"
#include "sph/terms/gas_flow.hpp"

namespace sph {
namespace {

constexpr double share = 0.3;  // of h^2 over the diffusivity: positive to 1/2.96
// Implicit: of the largest content, what a step may change, and what it must not; by how much steps may grow, and how
// many of the explicit limits they may be long.
constexpr double change_in_a_step = 0.05, most_change = 0.2, growth_of_steps = 1.5, longest_explicit = 20;

[[nodiscard]] bool flows(const Group& g) { return g.bubbly.permeability.coefficient > 0; }

/// b of a particle: density of its gas, times f(psi), over its viscosity [s/m^2].
double mobility(const Group& g, double absolute_pressure, double void_fraction, bool connected = false) {
  if (!flows(g) || !(absolute_pressure > 0)) return 0;
  return absolute_pressure / g.bubbly.gas_rt *
         relative_permeability(g.bubbly.permeability, void_fraction, connected) /
         g.bubbly.permeability.gas_viscosity;
}

/// Bubbles of some group stay connected below the threshold.
bool latches(const Group& g) { return flows(g) && g.bubbly.permeability.closing_threshold.has_value(); }
/// Gas of some group is fast.
bool has_inertia(const Group& g) { return flows(g) && g.bubbly.permeability.inertial_coefficient > 0; }

struct Mobilities {
  static constexpr FieldSet reads{Field::position, Field::pressure, Field::void_fraction, Field::group};
  static constexpr FieldSet writes{Field::gas_mobility, Field::gas_pressure, Field::connected};
  const Scene* scene;
  const Materials* materials;

  void operator()(const View<reads, writes>& p, const Step& step) const {
    const double *pressure = p.get<Field::pressure>(), *psi = p.get<Field::void_fraction>();
    const auto* group = p.get<Field::group>();
    double *b = p.get<Field::gas_mobility>(), *drives = p.get<Field::gas_pressure>();
    for_movers(step.ranges, [&](std::size_t i) {
      const Group& g = scene->groups[group[i]];
      const double outside = materials->outer(p, i, g);
      b[i] = mobility(g, pressure[i] + outside, psi[i], connect(p, i, g, psi[i]));
      drives[i] = pressure[i] + (outside - scene->domain.surface_pressure);
    });
    for_walls(step.ranges, [&](std::size_t i) {
      b[i] = 0;
      drives[i] = scene->groups[group[i]].wall.gas_pressure.value_or(0);
    });
  }

  /// A bubble that was connected stays so until it shrinks below the closing threshold.
  static bool connect(const View<reads, writes>& p, std::size_t i, const Group& g, double psi) {
    auto* connected = p.get<Field::connected>();
    if (connected == nullptr) return false;
    const Permeability& m = g.bubbly.permeability;
    const bool was = connected[i] != 0;
    connected[i] = latches(g) && (psi > m.threshold || (was && psi > *m.closing_threshold)) ? 1 : 0;
    return connected[i] != 0;
  }
};

/// What its inertia leaves of the gas's flow.
struct Inertia {
  static constexpr FieldSet reads{Field::gas_slope, Field::gas_pressure, Field::group};
  static constexpr FieldSet writes{Field::gas_mobility};
  const Scene* scene;

  void operator()(const View<reads, writes>& p, const Step& step) const {
    const auto d = static_cast<std::size_t>(p.dim());
    const double *sums = p.get<Field::gas_slope>(), *pressure = p.get<Field::gas_pressure>();
    for_movers(step.ranges, [&](std::size_t i) {
      const Group& g = scene->groups[p.get<Field::group>()[i]];
      double& b = p.get<Field::gas_mobility>()[i];
      const double *own = sums + i * (d + 1),
                   density = (pressure[i] + scene->domain.surface_pressure) / g.bubbly.gas_rt;
      if (!has_inertia(g) || !(density > 0) || own[d] == 0) return;
      double square = 0;
      for (std::size_t a = 0; a < d; ++a) square += own[a] * own[a];
      const double gradient =
          static_cast<double>(d) * std::sqrt(square) / std::fabs(own[d]) / scene->kernel.smoothing_length;
      const Permeability& m = g.bubbly.permeability;
      b *= inertial_share(m, m.coefficient * b * m.gas_viscosity / density, density, gradient);
    });
  }
};

struct Contents {
  static constexpr FieldSet reads = FaultView::reads | GasContents::reads | GasOutside::reads |
                                    Materials::reads | FieldSet{Field::trial, Field::temperature};
  static constexpr FieldSet writes =
      Materials::writes | GasContents::writes | FieldSet{Field::gas_inflow, Field::heat_inflow};
  const SphConstants* constants;
  const Materials* materials;
  GasOutside outside;
  bool implicit;
  std::shared_ptr<ContentChange> change;

  void operator()(const View<reads, writes>& p, const Step& step) const {
    *change = {};
    for (RowClass c : {RowClass::interior_movers, RowClass::boundary_movers}) {
      const RowRange& r = range_of(step.ranges, c);
      for (std::size_t i = r.first; i < r.last; ++i) exchange(p, i, step);
      materials->derive(p, r.first, r.last);
    }
  }

  void exchange(const View<reads, writes>& p, std::size_t i, const Step& step) const {
    const auto d = static_cast<std::size_t>(p.dim());
    const double dt = step.global.dt, liquid = p.get<Field::liquid_mass>()[i];
    if (!(liquid > 0)) return;  // of no bubbly group
    const double m = p.get<Field::gas_content>()[i];
    const double* gain = p.get<Field::gas_gain>() + i * (d + 1);
    const double drive = (implicit ? p.get<Field::trial>() : p.get<Field::gas_pressure>())[i];
    const double from_outside = outside.rate(p, i, drive), more = dt * (gain[0] + from_outside) / liquid;
    change->see(std::fabs(more), m);
    if (gain[0] == 0 && from_outside == 0) return;
    if (GasContents::is_fault(*constants, p, i, m + more, step)) return;
    if (double* inflow = p.get<Field::gas_inflow>()) inflow[i] += dt * from_outside;
    GasContents::take_in(p, i, dt, more, heat_from_outside(p, i, dt * from_outside));
  }

  /// What comes and goes through walls and the surface is as warm as the particle [J].
  double heat_from_outside(const View<reads, writes>& p, std::size_t i, double gas) const {
    if (p.get<Field::enthalpy>() == nullptr) return 0;
    const Group& g = constants->scene->groups[p.get<Field::group>()[i]];
    const double heat = gas * (g.heat.material.specific_heat * p.get<Field::temperature>()[i]);
    if (double* inflow = p.get<Field::heat_inflow>()) inflow[i] += heat;
    return heat;
  }
};

}  // namespace

bool has_open_walls(const Scene& scene) {
  return std::ranges::any_of(scene.groups, [](const Group& g) { return g.wall.gas_pressure.has_value(); });
}

bool has_escape(const Scene& scene) {
  return scene.has_gas_flow() && scene.start.has_surface && scene.terms.exchange.gas_escape;
}

void Degassing::add_to(Builder& b) const {
  const Scene& s = b.scene();
  const bool walls = has_open_walls(s), escape = has_escape(s);
  b.add_fields({Field::liquid_mass, Field::gas_mobility, Field::gas_pressure});
  if (walls || escape) b.add_fields({Field::gas_inflow});
  if ((walls || escape) && s.has_heat()) b.add_fields({Field::heat_inflow});
  if (std::ranges::any_of(s.groups, latches)) b.add_fields({Field::connected});
  b.add_update("gas mobilities", Mobilities{&s, materials_});
  if (std::ranges::any_of(s.groups, has_inertia)) {
    add_exchange(b, "slopes of gas pressure", {term<GasSlope>});
    b.add_update("inertia of gas", Inertia{&s});
  }
  const bool implicit = s.terms.exchange.implicit_gas_flow;
  const GasOutside outside{constants_, escape ? std::make_shared<const SurfaceEscape>(*constants_) : nullptr};
  if (walls) add_exchange(b, "gas of walls", {term<WallGas>});
  if (implicit) {
    add_exchange(b, "gas flow at the start", {term<GasFlow>});
    add_implicit_gas_pressures(b, outside);
  }
  std::vector<Term> terms{implicit ? term<ImplicitGasFlow> : term<GasFlow>};
  if (s.has_heat()) terms.push_back(implicit ? term<ImplicitGasHeat> : term<GasHeat>);
  add_exchange(b, "gas flow", terms);
  b.add_update("gas contents", Contents{constants_, materials_, outside, implicit, change_});
}

void Degassing::reserve(Reduction& r) {
  in_.conductance = r.add_maximum();
  in_.stiffness = r.add_maximum();
  if (!constants_->scene->terms.exchange.implicit_gas_flow) return;
  in_.change = r.add_maximum();
  in_.content = r.add_maximum();
  in_.dt = r.add_maximum();
}

void ContentChange::see(double change, double of) {
  most = larger(change, most);
  content = larger(of, content);
}

void Degassing::Fastest::see(double of_conductance, double of_stiffness) {
  conductance = larger(of_conductance, conductance);
  stiffness = larger(of_stiffness, stiffness);
}

double Degassing::start(const decomp::Comm& comm, Particles& p, GlobalState&) {
  const Scene& scene = *constants_->scene;
  GasContents::start(*constants_, p);
  const Fastest own = at_start(p);
  std::array<double, 2> largest{own.conductance, own.stiffness};
  comm.max(largest);
  const double longest = limit({largest[0], largest[1]});
  if (scene.time.dt && *scene.time.dt > longest && !scene.terms.exchange.implicit_gas_flow)
    throw InputError(fmt::format(
        "{}: time.dt: {:.6g} s is above the limit of gas that flows, {:.6g} s; set it to that or less, "
        "leave it out, or set terms.implicit_gas_flow",
        scene.file, *scene.time.dt, longest));
  if (scene.time.dt) return *scene.time.dt;
  return scene.terms.exchange.implicit_gas_flow ? longest / growth_of_steps / growth_of_steps : longest;
}

Degassing::Fastest Degassing::at_start(const Particles& p) const {
  const Scene& scene = *constants_->scene;
  const auto* group = p.data<Field::group>();
  const double *rho = p.data<Field::density>(), *content = p.data<Field::gas_content>();
  Fastest found;
  for (std::size_t i = 0; i < p.owned(); ++i) {
    const Group& g = scene.groups[group[i]];
    if (!flows(g)) continue;
    const BubblyEos eos = bubbly_eos(g, content[i]);
    const double pressure = eos.pressure(rho[i]);
    const double dissolved = dissolved_gas(g, content[i], pressure);  // all starts in equilibrium
    found.see(g.bubbly.permeability.coefficient * mobility(g, pressure, eos.void_fraction(pressure)),
              gas_stiffness(g, content[i], &dissolved, pressure));
  }
  return found;
}

double Degassing::limit(const Fastest& found) const {
  const double h = constants_->scene->kernel.smoothing_length,
               diffusivity = found.conductance * found.stiffness;
  return diffusivity > 0 ? share * h * h / diffusivity : any_step;
}

// With the pressures that the gas has flowed by in this step.
bool Degassing::report(const StepState& s, Reduction& r) {
  const Scene& scene = *constants_->scene;
  const Particles& p = s.particles;
  const auto* group = p.data<Field::group>();
  const double *b = p.data<Field::gas_mobility>(), *pressure = p.data<Field::gas_pressure>();
  const double* w = p.data<Field::dissolved_gas>();
  Fastest found;
  for (std::size_t i = 0; i < p.owned(); ++i) {
    const Group& g = scene.groups[group[i]];
    if (flows(g))
      found.see(g.bubbly.permeability.coefficient * b[i],
                gas_stiffness(g, p.data<Field::gas_content>()[i], w != nullptr ? w + i : nullptr,
                              pressure[i] + scene.domain.surface_pressure));
  }
  r[in_.conductance] = found.conductance;
  r[in_.stiffness] = found.stiffness;
  if (scene.terms.exchange.implicit_gas_flow) {
    r[in_.change] = change_->most;
    r[in_.content] = change_->content;
    r[in_.dt] = s.global.dt;
  }
  return std::isfinite(found.conductance) && std::isfinite(found.stiffness);
}

double Degassing::longest_step(const Reduction& r) const {
  const Scene& scene = *constants_->scene;
  if (scene.time.dt) return *scene.time.dt;
  const double by_stability = limit({r[in_.conductance], r[in_.stiffness]});
  if (!scene.terms.exchange.implicit_gas_flow) return by_stability;
  if (!(r[in_.dt] > 0) || !std::isfinite(by_stability)) return any_step;  // no step yet, or nothing flows
  const double dt = r[in_.dt], faster = r[in_.change] / (change_in_a_step * r[in_.content]);
  const double longer = faster > 1 / growth_of_steps ? dt / faster : growth_of_steps * dt;
  return std::fmin(longer, longest_explicit * by_stability);
}

void Degassing::guard_step(const Reduction& r, const GlobalState& global) const {
  const Scene& scene = *constants_->scene;
  if (scene.terms.exchange.implicit_gas_flow) {
    const double change = r[in_.change] / r[in_.content];
    if (scene.time.dt && change > most_change)
      throw GuardError(
          fmt::format("step {}: a gas content changes by {:.2g} of the largest; set time.dt to {:.3g} s or "
                      "less, or leave it out",
                      global.step, change, change_in_a_step / change * r[in_.dt]));
    return;
  }
  const double longest = limit({r[in_.conductance], r[in_.stiffness]});
  if (scene.time.dt && *scene.time.dt > longest)
    throw GuardError(fmt::format(
        "step {}: the gas flows too fast for the time step: set time.dt to {:.3g} s or less, leave "
        "it out, or set terms.implicit_gas_flow",
        global.step, 0.9 * longest));
}

}  // namespace sph
