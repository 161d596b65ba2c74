// What a scene of fluids and solids has to say at the end of a step.
#include <cmath>

#include "sph/models/physics.hpp"

namespace sph {

void Physics::reserve(Reduction& r) {
  for (Reduction::Maximum* slot : {&in_.sound, &in_.viscosity, &in_.growth}) *slot = r.add_maximum();
}

bool Physics::report(const StepState& s, Reduction& r) {
  if (reach_) r[in_.growth] = reach_->growth(s.particles);
  if (!std::isfinite(s.maxima.sound)) return false;
  r[in_.sound] = s.maxima.sound;
  r[in_.viscosity] = s.maxima.viscosity;
  return true;
}

double Physics::longest_step(const Reduction& r) const {
  return steps_.longest({r[Reduction::speed], r[Reduction::acceleration], 0, r[in_.sound], r[in_.viscosity]});
}

void Physics::guard_step(const Reduction& r, const GlobalState& global) const {
  steps_.guard(r[in_.sound], global);
  steps_.guard_viscosity(r[in_.viscosity], global);
}

}  // namespace sph
