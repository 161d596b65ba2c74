#include "models/stability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "models/damping_limit.hpp"
#include "sph/models/grain_limits.hpp"
#include "sph/models/heat.hpp"
#include "sph/models/sph_time_step.hpp"
#include "sph/models/water.hpp"
#include "start/start_sounds.hpp"

namespace sph {
namespace {

constexpr double rounded = 0.99;  // what is below a limit is so with three digits too

void check_contact_step(const Scene& scene) {
  if (!any_grain_moves(scene)) return check_wall_speeds(scene);
  const GrainTimeSteps steps = grain_time_steps(scene);
  if (scene.time.dt && *scene.time.dt > steps.limit)
    throw InputError(
        fmt::format("{}: time.dt: {:.6g} s is above the limit of a stable contact, {:.6g} s; set it "
                    "to {:.6g} s or less",
                    scene.file, *scene.time.dt, steps.limit, std::min(steps.advised, rounded * steps.limit)));
  const double dt = grain_step(scene);
  if (!(steps.limit > 0 && std::isfinite(steps.advised) && dt > 0 && std::isfinite(dt)))
    throw InputError(
        fmt::format("{}: group: the stiffness of grains, over the square of their restitution where that "
                    "makes it, leaves no time step ({:.6g} s); check its unit",
                    scene.file, steps.limit));
  check_wall_speeds(scene);
}

}  // namespace

void check_time_step(const Scene& scene) {
  if (scene.has_grains() && !scene.has_melt()) check_contact_step(scene);
  if (!scene.has_matter()) return;
  if (const double limit = longest_heat_step(scene); scene.time.dt && limit > 0 && *scene.time.dt > limit)
    throw InputError(fmt::format(
        "{}: time.dt: {:.6g} s is above the limit of explicit conduction, {:.6g} s; set it to that or less",
        scene.file, *scene.time.dt, limit));
  check_water_step(scene);
  // What stiffens under pressure is looked at once it is there, by a start and by `check`.
  if (std::ranges::any_of(scene.groups, stiffens)) return;
  const SphConstants constants(scene, position_scale(scene));
  check_time_step(scene, SphTimeStep(constants), sounds_at_rest(scene));
}

void check_time_step(const Scene& scene, const SphTimeStep& steps, const std::vector<double>& sounds) {
  if (!scene.terms.exchange.motion) return;
  const double dt = steps.resting(sounds), courant = steps.courant_number(dt, sounds);
  const char* key = scene.time.dt ? "time.dt" : "time.cfl";
  if (courant > courant_limit(scene))
    throw InputError(
        fmt::format("{}: {}: c dt/h = {:.3g} is above the integrator's limit {}; set it to {:.3g}{} or less",
                    scene.file, key, courant, courant_limit(scene),
                    rounded * courant_limit(scene) / courant * scene.time.dt.value_or(scene.time.cfl),
                    scene.time.dt ? " s" : ""));
  const DampingLimit limit = damping_limit(scene, sounds, dt);
  if (dt <= limit.step) return;
  std::string right;
  if (limit.most > 0) right = fmt::format("set it to {:.3g} or less, or ", rounded * limit.most);
  right += scene.time.dt
               ? fmt::format("set time.dt to {:.3g} s or less", rounded * limit.step)
               : fmt::format("set time.cfl to {:.3g} or less", rounded * limit.step / dt * scene.time.cfl);
  const bool of_motion = limit.key.empty();  // nothing damps too much: the step itself is too long
  throw InputError(fmt::format("{}: {}: {:.6g} is unstable with time steps of {:.3g} s; {}", scene.file,
                               of_motion ? key : limit.key,
                               of_motion ? scene.time.dt.value_or(scene.time.cfl) : limit.value, dt, right));
}

}  // namespace sph
