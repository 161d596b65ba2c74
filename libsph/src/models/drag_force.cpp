#include "sph/models/drag_force.hpp"

#include <algorithm>
#include <cmath>

#include "models/screening.hpp"
#include "sph/laws/drag/law.hpp"

namespace sph {
namespace {

/// A force F spread with the kernel moves the fluid, as seen through the kernel too, by m F / (eta h):
///   m = (2/3) (2 pi)^-3 int W(k)^2 / L(k) d^3k,
/// W(k) the transform of the kernel for h = 1 and L(k) that of the viscous term, whose forms differ at wave lengths
/// of a few h (for L = k^2 it is (1/6 pi) <1/r> over two points spread with the kernel: 0.0432, 0.0570, 0.0652).
double self_mobility(const Scene& scene) {
  const bool symmetric = scene.terms.viscous.form == ViscosityForm::symmetric;
  switch (scene.kernel.shape) {
    case KernelShape::wendland_c2:
      return symmetric ? 0.0621 : 0.0645;
    case KernelShape::wendland_c4:
      return symmetric ? 0.0711 : 0.0739;
    case KernelShape::quintic:
      break;
  }
  return symmetric ? 0.0472 : 0.0492;
}

}  // namespace

DragForce::DragForce(const Scene& scene)
    : scene_(&scene),
      law_(scene.grains.drag.law),
      self_mobility_(scene.grains.drag.own_disturbance ? self_mobility(scene) : 0.0) {}

// F = V theta + z (u - v') with the velocity v' = v + dt F / m after it and z that of the drag law at the speed
// relative to the fluid without the grain's own disturbance,
//   F_d = zeta (u_0 - v'),   u = u_0 - a F_d,   so  z = zeta / (1 - a zeta),
// and theta has z (u - v') / V from the fluid that it holds, `own` of it: both are what the grain alone does,
// which grains around it screen, and the first of which is less where the fluid passes within the time that momentum takes
// to spread over h. zeta depends on the speed and the speed on it: the mean of the logarithms of old and new
// converges for forces linear and quadratic in the speed alike.
Push DragForce::operator()(const FluidAround& around, const GrainInFluid& grain, double dt) const {
  constexpr int rounds = 8;
  constexpr double most = 0.8;  // of a zeta: beyond that the grain is too large for h
  const double volume = volume_of(0.5 * grain.diameter), mass_over_dt = grain.mass / dt;
  const double h = scene_->kernel.smoothing_length, solid = 1 - around.porosity;
  const double screen = scene_->grains.drag.own_disturbance ? unscreened(solid_around(solid, around.own)) : 0;
  DragState state{std::min(1.0, around.porosity + screen * around.own), 0, around.density, around.viscosity,
                  grain.diameter};
  Double3 moved{}, relative{};
  double speed2 = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    moved[a] = grain.v[a] + (grain.fixed ? 0.0 : volume * around.immersed * around.stress[a] / mass_over_dt);
    relative[a] = around.velocity[a] - moved[a];
    speed2 += relative[a] * relative[a];
  }
  const double before = std::sqrt(speed2);
  double speed = before, resistance = 0;
  for (int round = 0; round < rounds; ++round) {
    state.speed = speed;
    const double zeta = law_->resistance(state);
    const double reynolds = around.density * speed * h / around.viscosity;
    const double own = around.viscosity > 0
                           ? screen * self_mobility_ / (around.viscosity * h * (1 + 0.53 * reynolds)) * zeta
                           : 0.0;
    const double left = 1 - std::min(own, most);
    resistance = around.immersed * zeta / left * (1 - screen * around.own);
    const double slowed = grain.fixed ? before : before / (1 + resistance / mass_over_dt);
    speed = std::sqrt(speed * (slowed / left));
  }
  const double lag = grain.fixed ? 1.0 : 1 / (1 + resistance / mass_over_dt);
  Push push{};
  for (std::size_t a = 0; a < 3; ++a) {
    push.drag[a] = resistance * lag * relative[a];
    push.force[a] = around.immersed * volume * around.stress[a] + push.drag[a];
  }
  // With n grains per volume the fluid takes on their velocity at the rate n z / rho, less where they take on its
  // own in the same step: dt n z / (1 + dt z / m) / rho is to stay below the usual share.
  const double taken = solid / (volume * around.porosity * around.density);
  const double given = grain.fixed ? 0.0 : usual_share / grain.mass;
  // Where pressure moves grains of the density rho_s, too, sound has the speed c sqrt(1 + (1 - e) rho / (e rho_s)).
  const double lighter = grain.fixed ? 0.0 : solid * around.density * volume / (around.porosity * grain.mass);
  push.limits = {resistance * (taken - given), around.sound * std::sqrt(1 + std::max(lighter, 0.0))};
  return push;
}

}  // namespace sph
