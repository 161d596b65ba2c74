#include "physics/stability.hpp"

#include <fmt/format.h>

#include "sph/grains.hpp"
#include "sph/physics.hpp"

namespace sph {

double courant_number_of(const Scene& scene) {
  const Physics physics(scene, position_scale(scene));
  return physics.courant_number(physics.time_step({}));
}

void check_time_step(const Scene& scene) {
  if (scene.of_grains()) {
    const GrainTimeSteps steps = grain_time_steps(scene);
    if (scene.time.dt && *scene.time.dt > steps.limit)
      throw InputError(
          fmt::format("{}: time.dt: {:.6g} s is above the limit of a stable contact, {:.6g} s; set it "
                      "to {:.6g} s or less",
                      scene.file, *scene.time.dt, steps.limit, steps.advised));
    return;
  }
  const double courant = courant_number_of(scene);
  if (courant <= courant_limit(scene)) return;
  const double ratio = courant_limit(scene) / courant;
  throw InputError(
      fmt::format("{}: {}: c dt/h = {:.3g} is above the integrator's limit {}; set it to {:.3g}{} or less",
                  scene.file, scene.time.dt ? "time.dt" : "time.cfl", courant, courant_limit(scene),
                  ratio * scene.time.dt.value_or(scene.time.cfl), scene.time.dt ? " s" : ""));
}

}  // namespace sph
