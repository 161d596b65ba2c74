#include "stability.hpp"

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
  throw InputError(fmt::format(
      "{}: {}: c dt/h = {:.3g} is above the integrator's limit {}; reduce it by {:.3g}", scene.file,
      scene.time.dt ? "time.dt" : "time.cfl", courant, courant_limit, courant / courant_limit));
}

}  // namespace sph
