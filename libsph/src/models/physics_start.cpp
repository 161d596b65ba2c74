// What a scene of fluids and solids begins with.
#include <algorithm>
#include <array>
#include <cmath>

#include "models/stability.hpp"
#include "pairs/for_rows.hpp"
#include "sph/laws/eos/law.hpp"
#include "sph/models/physics.hpp"
#include "start/start_densities.hpp"
#include "start/start_sounds.hpp"

namespace sph {

double Physics::start(const decomp::Comm& comm, Particles& particles, GlobalState& global) {
  check_start_densities(comm, *scene_, particles);
  const StepMaxima own = maxima_at_start(particles);
  std::array<double, 3> largest{own.speed, own.sound, own.viscosity};
  comm.max(largest);
  if (stiffens_) {
    const std::vector<double> sounds = fastest_sounds(comm, *scene_, particles);
    check_time_step(*scene_, *this, sounds);
    largest[1] = std::ranges::max(sounds);
  }
  global.max_speed = largest[0];
  if (shifting_) find_common_motion(comm, particles, global);
  return time_step({largest[0], 0, 0, largest[1], largest[2]});
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
  maxima.speed = std::sqrt(speed2);
  return maxima;
}

void Physics::find_common_motion(const decomp::Comm& comm, Particles& particles, GlobalState& global) const {
  const Shifting::Motion moving(particles);
  global.fluid_volume.start = global.fluid_volume.now = comm.sum(shifting_->fluid_volume(moving));
  // The mean first, then the largest difference from it, then all.
  global.motion.largest = global.max_speed;
  for (int k = 0; k < 3; ++k) {
    MotionSums motion = shifting_->motion_sums(moving, global);
    comm.sum(std::span<std::int64_t>(motion.sums));
    std::array<double, 1> most{motion.largest};
    comm.max(most);
    motion.largest = most[0];
    global.motion = shifting_->common_motion(motion, global);
  }
}

}  // namespace sph
