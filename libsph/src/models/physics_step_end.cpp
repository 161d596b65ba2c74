// What a scene of fluids and solids has to say at the end of a step.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sph/models/physics.hpp"

namespace sph {

void Physics::reserve(Reduction& r) {
  for (Reduction::Maximum* slot : {&sound_, &viscosity_, &growth_, &unlike_}) *slot = r.add_maximum();
  if (!shifting_) return;
  motion_ = r.add_sums(MotionSums{}.sums.size());
  volume_ = r.add_sums(1);
}

bool Physics::report(const StepState& s, Reduction& r) {
  const StepMaxima& maxima = s.maxima;
  if (reach_) r[growth_] = reach_->growth(s.particles);
  if (!std::isfinite(maxima.sound)) return false;
  r[sound_] = maxima.sound;
  r[viscosity_] = maxima.viscosity;
  if (!shifting_) return true;
  r[unlike_] = maxima.motion.largest;
  std::ranges::copy(maxima.motion.sums, r[motion_].begin());
  r[volume_][0] = maxima.volume;
  return true;
}

void Physics::act(const Reduction& r, GlobalState& global) {
  if (!shifting_) return;
  MotionSums motion{{}, r[unlike_]};
  std::ranges::copy(r[motion_], motion.sums.begin());
  global.motion = shifting_->common_motion(motion, global);
  if (!scene_->open) global.fluid_volume.now = r[volume_][0];
}

double Physics::longest_step(const Reduction& r) const {
  return time_step({r[Reduction::speed], r[Reduction::acceleration], 0, r[sound_], r[viscosity_]});
}

void Physics::guard_step(const Reduction& r, const GlobalState& global) const {
  if (!scene_->time.dt) return;
  const double limit = courant_limit(*scene_),
               courant = r[sound_] * *scene_->time.dt / scene_->smoothing_length;
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
                  global.step, courant, limit, 0.9 * limit / courant * *scene_->time.dt));
}

}  // namespace sph
