// What a scene of fluids and solids has to say at the end of a step.
#include <cmath>

#include "pairs/for_rows.hpp"
#include "sph/models/physics.hpp"

namespace sph {

void Physics::reserve(Reduction& r) {
  for (Reduction::Maximum* slot : {&in_.sound, &in_.viscosity, &in_.bulk, &in_.growth})
    *slot = r.add_maximum();
}

bool Physics::report(const StepState& s, Reduction& r) {
  if (reach_) r[in_.growth] = reach_->growth(s.particles);
  if (!std::isfinite(s.maxima.sound)) return false;
  r[in_.sound] = s.maxima.sound;
  StepMaxima maxima = s.maxima;
  look_at_viscosities(s.particles, maxima);
  r[in_.viscosity] = maxima.viscosity;
  r[in_.bulk] = maxima.bulk;
  return true;
}

// Where gas makes a fluid light, the same forces shake it more. A fluid without a law has its group's viscosity.
void Physics::look_at_viscosities(const Particles& p, StepMaxima& maxima) const {
  if (!bubbly_) return;
  const auto* group = p.data<Field::group>();
  const double *rho = p.data<Field::density>(), *eta = p.data<Field::viscosity>();
  for (std::size_t i = 0; i < p.owned(); ++i) {
    const Group& g = scene_->groups[group[i]];
    if (!viscosity_follows(g)) continue;
    maxima.viscosity = larger((eta != nullptr ? eta[i] : g.viscosity) / rho[i], maxima.viscosity);
    maxima.bulk = larger(g.viscosity_law.bulk / rho[i], maxima.bulk);
  }
}

double Physics::longest_step(const Reduction& r) const {
  return steps_.longest(
      {r[Reduction::speed], r[Reduction::acceleration], 0, r[in_.sound], r[in_.viscosity], r[in_.bulk]});
}

void Physics::guard_step(const Reduction& r, const GlobalState& global) const {
  steps_.guard(r[in_.sound], global);
  steps_.guard_viscosity(r[in_.viscosity], r[in_.bulk], global);
}

}  // namespace sph
