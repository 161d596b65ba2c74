#include "sph/models/heat.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "models/conduction_solver.hpp"
#include "pairs/for_rows.hpp"
#include "sph/laws/enthalpy.hpp"
#include "sph/laws/eos/law.hpp"
#include "sph/models/faults.hpp"
#include "sph/models/models.hpp"
#include "sph/terms/conduction.hpp"
#include "sph/terms/viscous_heat.hpp"

namespace sph {
namespace {

// Of h^2 over the diffusivity. A lattice is positive to 1/2.96, and beside a wall that keeps a temperature, which has
// twice the bulk's rate where a particle is a quarter of the spacing from it, still stable.
constexpr double share = 0.25;

struct Temperatures {
  static constexpr FieldSet reads =
      FaultView::reads | FieldSet{Field::heat_gain, Field::wall_heat, Field::viscous_heat, Field::mass};
  static constexpr FieldSet writes{Field::enthalpy, Field::temperature, Field::heat_inflow};
  const SphConstants* constants;

  void operator()(const View<reads, writes>& p, const Step& step) const {
    const Scene& scene = *constants->scene;
    const double dt = step.global.dt;
    const double *gain = p.get<Field::heat_gain>(), *of_walls = p.get<Field::wall_heat>();
    const double* friction = p.get<Field::viscous_heat>();
    const double* mass = p.get<Field::mass>();
    const auto* group = p.get<Field::group>();
    double *h = p.get<Field::enthalpy>(), *t = p.get<Field::temperature>(),
           *inflow = p.get<Field::heat_inflow>();
    for_movers(step.ranges, [&](std::size_t i) {
      const double outside =
          (of_walls != nullptr ? of_walls[2 * i] : 0.0) + (friction != nullptr ? friction[i] : 0.0);
      h[i] += dt * (gain[i] + outside) / mass[i];
      if (inflow != nullptr) inflow[i] += dt * outside;
      t[i] = temperature(scene.groups[group[i]].heat.material, h[i]);
      if (!(h[i] >= 0 && std::isfinite(h[i])))
        find_fault(*constants, p, i, step,
                   fmt::format("is at {:.3g} K; reduce time.dt, or the heat that walls take", t[i]));
    });
  }
};

/// Some walls have a coefficient or radiate.
bool takes_heat(const Scene& scene) {
  return std::ranges::any_of(scene.groups, [](const Group& g) {
    return g.heat.transfer.coefficient > 0 || g.heat.radiation.emissivity > 0;
  });
}

double mean_conductivity(const Group& a, const Group& b) {
  const double sum = a.heat.material.conductivity + b.heat.material.conductivity;
  return sum > 0 ? 2 * a.heat.material.conductivity * (b.heat.material.conductivity / sum) : 0;
}

/// The largest k / c beside any matter [kg/m/s].
double fastest_beside(const Scene& scene, const Group& g) {
  double most = 0;
  for (const Group& other : scene.groups)
    if (is_matter(g) && is_matter(other) && g.heat.material.specific_heat > 0)
      most = std::max(most, mean_conductivity(g, other) / g.heat.material.specific_heat);
  return most;
}

}  // namespace

double longest_heat_step(const Scene& scene) {
  if (scene.terms.exchange.implicit_conduction) return 0;
  const double h = scene.kernel.smoothing_length;
  double fastest = 0;
  for (const Group& g : scene.groups)
    if (is_matter(g)) fastest = std::max(fastest, fastest_beside(scene, g) / g.density);
  return fastest > 0 ? share * h * h / fastest : 0;
}

Heat::Heat(std::size_t set, const SphConstants& constants) : Model(set), constants_(&constants) {
  const Scene& scene = *constants.scene;
  const bool limited = !scene.terms.exchange.implicit_conduction;
  for (const Group& g : scene.groups)
    of_bubbly_.push_back(
        limited && is_matter(g) && g.eos.law->kind == EosKind::bubbly ? fastest_beside(scene, g) : 0.0);
  bubbly_ = std::ranges::any_of(of_bubbly_, [](double most) { return most > 0; });
}

bool has_warm_walls(const Scene& scene) {
  return takes_heat(scene) || std::ranges::any_of(scene.groups, [](const Group& g) {
           return g.kind == GroupKind::wall && (g.heat.temperature || g.heat.wall_flux);
         });
}

void Heat::add_to(Builder& b) const {
  b.add_fields({Field::enthalpy, Field::temperature});
  const Terms& terms = b.scene().terms;
  const bool implicit = terms.exchange.implicit_conduction;
  if (!implicit) add_exchange(b, "conduction", {term<Conduction>});
  if (has_warm_walls(b.scene()) || terms.exchange.viscous_heat) b.add_fields({Field::heat_inflow});
  if (terms.exchange.viscous_heat)
    add_exchange(
        b, "viscous heat",
        {terms.viscous.form == ViscosityForm::symmetric ? term<SymmetricViscousHeat> : term<ViscousHeat>});
  if (has_warm_walls(b.scene()))
    add_exchange(b, "heat of walls",
                 {takes_heat(b.scene()) ? term<WallTransferConduction> : term<WallConduction>});
  if (implicit)
    add_implicit_conduction(b);
  else
    b.add_update("temperatures", Temperatures{constants_});
}

void Heat::reserve(Reduction& r) {
  if (bubbly_) diffusivity_ = r.add_maximum();
}

double Heat::start(const decomp::Comm& comm, Particles& p, GlobalState&) {
  const Scene& scene = *constants_->scene;
  const auto* group = p.data<Field::group>();
  const double* t = p.data<Field::temperature>();
  double* h = p.data<Field::enthalpy>();
  for (std::size_t i = 0; i < p.owned(); ++i)
    h[i] = constants_->is_wall(group[i]) ? 0.0 : enthalpy(scene.groups[group[i]].heat.material, t[i]);
  std::array<double, 1> largest{fastest(p)};
  comm.max(largest);
  const double longest = limit(largest[0]);
  if (scene.time.dt && *scene.time.dt > longest)
    throw InputError(fmt::format(
        "{}: time.dt: {:.6g} s is above the limit of explicit conduction, {:.6g} s where gas makes the fluid "
        "light; set it to that or less, leave it out, or set terms.implicit_conduction",
        scene.file, *scene.time.dt, longest));
  return scene.time.dt.value_or(longest);
}

/// Of bubbly fluids: where gas makes them light, they have less heat for the same conductivity [m^2/s].
double Heat::fastest(const Particles& p) const {
  double most = 0;
  const auto* group = p.data<Field::group>();
  const double* rho = p.data<Field::density>();
  for (std::size_t i = 0; bubbly_ && i < p.owned(); ++i) most = larger(of_bubbly_[group[i]] / rho[i], most);
  return most;
}

double Heat::limit(double diffusivity) const {
  const double h = constants_->scene->kernel.smoothing_length,
               of_scene = longest_heat_step(*constants_->scene);
  const double longest = of_scene > 0 ? of_scene : any_step;
  return diffusivity > 0 ? std::fmin(longest, share * h * h / diffusivity) : longest;
}

bool Heat::report(const StepState& s, Reduction& r) {
  if (!bubbly_) return true;
  r[diffusivity_] = fastest(s.particles);
  return std::isfinite(r[diffusivity_]);
}

double Heat::longest_step(const Reduction& r) const {
  const Scene& scene = *constants_->scene;
  if (scene.time.dt) return *scene.time.dt;
  return limit(bubbly_ ? r[diffusivity_] : 0.0);
}

void Heat::guard_step(const Reduction& r, const GlobalState& global) const {
  const Scene& scene = *constants_->scene;
  if (!bubbly_ || !scene.time.dt) return;
  if (const double longest = limit(r[diffusivity_]); *scene.time.dt > longest)
    throw GuardError(fmt::format(
        "step {}: gas has made the fluid so light that heat spreads too fast for the time step: set time.dt "
        "to {:.3g} s or less, leave it out, or set terms.implicit_conduction",
        global.step, 0.9 * longest));
}

void Heat::add_energies(const Particles& p, EnergySums& sums) const {
  const double *mass = p.data<Field::mass>(), *h = p.data<Field::enthalpy>();
  for (std::size_t i = 0; i < p.owned(); ++i)
    if (!constants_->is_wall(p.data<Field::group>()[i])) sums[Energy::internal].add(mass[i] * h[i]);
}

}  // namespace sph
