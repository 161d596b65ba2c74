#include "physics/stability.hpp"

#include <fmt/format.h>

#include "sph/physics.hpp"

namespace sph {

double courant_number_of(const Scene& scene) {
  const Physics physics(scene, position_scale(scene));
  return physics.courant_number(physics.time_step({}));
}

void check_time_step(const Scene& scene) {
  const double courant = courant_number_of(scene);
  if (courant <= courant_limit) return;
  const double ratio = courant_limit / courant;
  throw InputError(
      fmt::format("{}: {}: c dt/h = {:.3g} is above the integrator's limit {}; set it to {:.3g}{} or less",
                  scene.file, scene.time.dt ? "time.dt" : "time.cfl", courant, courant_limit,
                  ratio * scene.time.dt.value_or(scene.time.cfl), scene.time.dt ? " s" : ""));
}

}  // namespace sph
