#include "sph/models/sph_time_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "models/damping_limit.hpp"
#include "sph/core/error.hpp"
#include "sph/laws/eos/law.hpp"
#include "sph/models/viscosities.hpp"
#include "start/start_sounds.hpp"

namespace sph {

SphTimeStep::SphTimeStep(const SphConstants& constants)
    : constants_(&constants),
      gas_(has_eos(*constants.scene, EosKind::ideal_gas)),
      follows_(std::ranges::any_of(constants.scene->groups, viscosity_follows)) {}

double SphTimeStep::longest(const StepMaxima& maxima) const {
  const Scene& scene = *constants_->scene;
  if (scene.time.dt) return *scene.time.dt;
  if (!scene.terms.exchange.motion) return std::numeric_limits<double>::infinity();
  const double h = std::min(scene.kernel.smoothing_length, scene.bond_width());
  double fastest = maxima.sound, viscous = maxima.viscosity, bulk = maxima.bulk;
  const bool law = has_viscosity_law(scene);
  for (std::size_t g = 0; g < scene.groups.size(); ++g) {
    // Of a gas that of now counts, of a rigid body that of its contacts.
    if (is_quiet(scene, scene.groups[g])) continue;
    if (maxima.sound == 0 || !gas_) fastest = std::max(fastest, constants_->groups.sound_speed[g]);
    const bool wall = constants_->is_wall(static_cast<std::uint32_t>(g));
    if ((wall && (scene.total_lagrangian() || law)) || is_rigid(scene.groups[g])) continue;
    if ((maxima.viscosity > 0 || maxima.bulk > 0) && viscosity_follows(scene.groups[g])) continue;
    viscous = std::max(viscous, constants_->groups.viscosity[g] / scene.groups[g].density);
    bulk = std::max(bulk, scene.groups[g].viscosity_law.bulk / scene.groups[g].density);
  }
  const bool bonds = has_bonds(scene);
  if (bonds || scene.terms.viscous.form == ViscosityForm::symmetric)
    viscous *= 3;  // nu (lap v + 2 grad div v)
  if (scene.terms.viscous.implicit) viscous = 0;
  viscous += bulk;
  if (!gas_) fastest += maxima.speed;  // of a gas it is in `sound`
  double dt = scene.time.cfl * h / fastest;
  // Dashpots beside springs: the rates add.
  if (bonds && viscous > 0) dt = 1 / (1 / dt + viscous / (0.125 * h * h));
  if (viscous > 0) dt = std::min(dt, 0.125 * h * h / viscous);
  // Capillary waves as long as the layer is thick (Brackbill et al. 1992, eq. 61).
  if (const InterfaceTension& t = scene.terms.surface_tension; t.coefficient > 0) {
    double density = 0;
    for (int k : t.between) density += 0.5 * scene.groups[static_cast<std::size_t>(k)].density;
    dt = std::min(dt, 0.25 * std::sqrt(density * h * h * h / (2 * std::numbers::pi * t.coefficient)));
  }
  if (maxima.acceleration > 0) dt = std::min(dt, 0.25 * std::sqrt(h / maxima.acceleration));
  return dt;
}

double SphTimeStep::resting(const std::vector<double>& sounds) const {
  return longest(StepMaxima{0, 0, 0, std::ranges::max(sounds), 0});
}

double SphTimeStep::courant_number(double dt, const std::vector<double>& sounds) const {
  const Scene& scene = *constants_->scene;
  return std::ranges::max(sounds) * dt / std::min(scene.kernel.smoothing_length, scene.bond_width());
}

void SphTimeStep::guard(double sound, const GlobalState& global) const {
  const Scene& scene = *constants_->scene;
  if (!std::isfinite(global.dt))
    throw GuardError(fmt::format(
        "step {}: nothing moves, no gas flows any more, and nothing limits the time step; give time.dt",
        global.step));
  if (!scene.time.dt || !scene.terms.exchange.motion) return;
  const double limit = courant_limit(scene), courant = courant_number(*scene.time.dt, {sound});
  if (!(courant > limit)) return;
  if (gas_)
    throw GuardError(
        fmt::format("step {}: (c + u) dt/h is beyond the limit of {:f}, or the kernels of a gas that expands "
                    "grow too fast "
                    "for it; reduce time.dt",
                    global.step, limit));
  throw GuardError(
      fmt::format("step {}: c dt/h = {:.3g} is beyond the integrator's limit {}: pressure has made the "
                  "matter stiffer than "
                  "it was at the start; set time.dt to {:.3g} s or less",
                  global.step, courant, limit, 0.9 * limit / courant * *scene.time.dt));
}

void SphTimeStep::guard_viscosity(double viscosity, double bulk, const GlobalState& global) const {
  const Scene& scene = *constants_->scene;
  const double h = scene.kernel.smoothing_length, surely = 0.04 * h * h;
  if (!scene.terms.exchange.motion) return;
  if (!scene.time.dt || !follows_ || *scene.time.dt * (viscosity + bulk) <= surely) return;
  Scene now = scene;
  for (Group& g : now.groups) {
    if (!viscosity_follows(g)) continue;
    g.viscosity_law = ViscosityModel{};
    g.viscosity_law.bulk = bulk * g.density;
    g.viscosity = viscosity * g.density;
  }
  if (const double limit = damping_limit(now, sounds_at_rest(now), *scene.time.dt).step;
      *scene.time.dt > limit)
    throw GuardError(fmt::format(
        "step {}: viscosities reach {:.3g} and {:.3g} m^2/s (viscosity and bulk_viscosity over the density), "
        "and "
        "time.dt is above their limit {:.3g} s; set it to that or less, or leave it out{}",
        global.step, viscosity, bulk, limit,
        scene.terms.viscous.implicit || bulk > viscosity ? "" : ", or set terms.implicit_viscosity"));
}

}  // namespace sph
