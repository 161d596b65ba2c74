// What a scene of fluids and solids begins with.
#include <algorithm>
#include <array>
#include <cmath>

#include "models/stability.hpp"
#include "pairs/for_rows.hpp"
#include "sph/laws/eos/law.hpp"
#include "sph/models/exsolution.hpp"
#include "sph/models/physics.hpp"
#include "sph/models/viscosities.hpp"
#include "start/start_densities.hpp"
#include "start/start_sounds.hpp"

namespace sph {

double Physics::start(const decomp::Comm& comm, Particles& particles, GlobalState& global) {
  check_start_densities(comm, *scene_, particles);
  start_exsolution(constants_, particles);
  const StepMaxima own = maxima_at_start(particles);
  std::array<double, 4> largest{own.speed, own.sound, own.viscosity, own.bulk};
  comm.max(largest);
  if (stiffens_) {
    const std::vector<double> sounds = fastest_sounds(comm, *scene_, particles);
    check_time_step(*scene_, steps_, sounds);
    largest[1] = std::ranges::max(sounds);
  }
  try {
    steps_.guard_viscosity(largest[2], largest[3], global);
  } catch (const GuardError& error) {
    throw InputError(scene_->file + ": start: " + error.what());
  }
  global.max_speed = largest[0];
  return steps_.longest({largest[0], 0, 0, largest[1], largest[2], largest[3]});
}

void Physics::check_start(const decomp::Comm&, const StepState& state) const {
  if (!std::isfinite(state.global.dt))
    throw InputError(scene_->file +
                     ": terms.motion: is false, no gas flows at the start, and nothing limits the time step; "
                     "give time.dt");
}

StepMaxima Physics::maxima_at_start(Particles& p) const {
  const std::size_t d = static_cast<std::size_t>(p.dim());
  const double* v = p.data<Field::velocity>();
  double speed2 = 0;
  StepMaxima maxima;
  for (std::size_t i = 0; i < p.owned(); ++i) {
    double v2 = 0;
    for (std::size_t a = 0; a < d; ++a) v2 += v[i * d + a] * v[i * d + a];
    speed2 = v2 > speed2 ? v2 : speed2;
  }
  if (gas_) look_at_gas(constants_, GasView(p), 0, p.owned(), maxima);
  if (has_viscosity_law(*scene_)) {
    materials_.derive(ViewOf<Materials>(p), 0, p.owned());
    maxima.viscosity = Viscosities(constants_).derive(ViewOf<Viscosities>(p), 0, p.owned());
  }
  look_at_viscosities(p, maxima);
  maxima.speed = std::sqrt(speed2);
  return maxima;
}

}  // namespace sph
