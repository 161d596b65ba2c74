#include "sph/models/heat.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "models/conduction_solver.hpp"
#include "pairs/for_rows.hpp"
#include "sph/laws/enthalpy.hpp"
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

}  // namespace

double longest_heat_step(const Scene& scene) {
  if (scene.terms.exchange.implicit_conduction) return 0;
  const double h = scene.kernel.smoothing_length;
  double fastest = 0;
  for (const Group& g : scene.groups)
    for (const Group& other : scene.groups)
      if (is_matter(g) && is_matter(other) && g.heat.material.specific_heat > 0)
        fastest =
            std::max(fastest, mean_conductivity(g, other) / (g.density * g.heat.material.specific_heat));
  return fastest > 0 ? share * h * h / fastest : 0;
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

double Heat::start(const decomp::Comm&, Particles& p, GlobalState&) {
  const Scene& scene = *constants_->scene;
  const auto* group = p.data<Field::group>();
  const double* t = p.data<Field::temperature>();
  double* h = p.data<Field::enthalpy>();
  for (std::size_t i = 0; i < p.owned(); ++i)
    h[i] = constants_->is_wall(group[i]) ? 0.0 : enthalpy(scene.groups[group[i]].heat.material, t[i]);
  return longest_step(Reduction{});
}

double Heat::longest_step(const Reduction&) const {
  const Scene& scene = *constants_->scene;
  if (scene.time.dt) return *scene.time.dt;
  const double limit = longest_heat_step(scene);
  return limit > 0 ? limit : any_step;
}

void Heat::add_energies(const Particles& p, EnergySums& sums) const {
  const double *mass = p.data<Field::mass>(), *h = p.data<Field::enthalpy>();
  for (std::size_t i = 0; i < p.owned(); ++i)
    if (!constants_->is_wall(p.data<Field::group>()[i])) sums[Energy::internal].add(mass[i] * h[i]);
}

}  // namespace sph
