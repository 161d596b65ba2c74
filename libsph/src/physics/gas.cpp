// Ideal gases: density from the places of the particles, energy from compression, viscosity and conduction.
#include <algorithm>
#include <cmath>

#include "physics/for_rows.hpp"
#include "sph/physics.hpp"

namespace sph {

// One step, positions advanced: density and what compression does to the energy, walls, forces with their
// heat, kick and heat. The forces derive from the energy of compression, so that the step is symplectic but
// for its viscosity.
void Physics::build_gas() {
  add_pass("density", {Term::number_density}, true, false);
  passes_.back().update = [this](Particles& p, const RowRanges& ranges, const GlobalState& global) {
    update_gas(p, ranges, global);
  };
  passes_.back().changes = {Field::density, Field::specific_energy, Field::pressure, Field::sound_speed};
  if (scene_->has_kind(GroupKind::wall)) add_walls(false);
  add_pass("forces", {Term::gas_pressure, Term::viscosity, Term::shock_viscosity, Term::shock_heating}, true,
           false);
}

void Physics::update_gas(Particles& p, const RowRanges& ranges, const GlobalState& global) const {
  double* rho = p.data<Field::density>();
  double* energy = p.data<Field::specific_energy>();
  const double* sums = p.data<Field::number_density>();
  const double* mass = p.data<Field::mass>();
  const auto* group = p.data<Field::group>();
  const double of_neighbours = gradient_factor_ * scene_->smoothing_length;
  for_movers(ranges, [&](std::size_t i) {
    const double crowding = of_neighbours * (kernel_at_zero_ + sums[2 * i]);
    const double open = 1 - of_neighbours * sums[2 * i + 1];
    const double before = rho[i];
    rho[i] = mass[i] * row_scale_.inverse_volume * (crowding / open);
    // At the start there was no density before.
    if (before > 0)
      energy[i] = IdealGas{scene_->groups[group[i]].heat_ratio}.compressed(energy[i], rho[i] / before);
    if (!(open > 0)) fail_particle(p, i, global, "is inside a wall; reduce time.cfl or time.dt");
    if (!(energy[i] > 0)) fail_particle(p, i, global, "has no energy left; reduce time.cfl or time.dt");
    derive(p, i, i + 1);
  });
}

// The kick takes from the motion the work of the viscous forces on the mean of the velocities before and
// after it. Their heat was summed with those before: what is missing, dt/2 a.F_visc, is taken from the
// particle itself, and energy is conserved to second order.
void Physics::heat(Particles& p, const RowRanges& ranges, const GlobalState& global,
                   StepMaxima& maxima) const {
  double* energy = p.data<Field::specific_energy>();
  const double* heating = p.data<Field::heating>();
  const double* force = p.data<Field::force>();
  const double* mass = p.data<Field::mass>();
  const std::size_t d = static_cast<std::size_t>(p.dim());
  for (RowClass c : {RowClass::interior_movers, RowClass::boundary_movers}) {
    const RowRange& r = ranges[static_cast<std::size_t>(c)];
    for (std::size_t i = r.first; i < r.last; ++i) {
      const double* own = heating + i * (1 + d);
      double power = own[0];
      for (std::size_t a = 0; a < d; ++a)
        power -= 0.5 * global.dt * (force[i * d + a] / mass[i]) * own[1 + a];
      energy[i] += global.dt * (power / mass[i]);
      if (!(energy[i] > 0)) fail_particle(p, i, global, "has no energy left; reduce time.cfl or time.dt");
    }
    derive(p, r.first, r.last);
    look_at_gas(p, r.first, r.last, maxima);
  }
}

void Physics::look_at_gas(const Particles& p, std::size_t first, std::size_t last, StepMaxima& maxima) const {
  const double* rho = p.data<Field::density>();
  const double* energy = p.data<Field::specific_energy>();
  const auto* group = p.data<Field::group>();
  for (std::size_t i = first; i < last; ++i) {
    const Group& g = scene_->groups[group[i]];
    if (g.kind == GroupKind::wall) continue;
    const double sound = IdealGas{g.heat_ratio}.sound_speed(energy[i]);
    maxima.sound = larger(sound, maxima.sound);
    if (rho[i] > 0) maxima.viscosity = std::fmax(maxima.viscosity, g.viscosity / rho[i]);
  }
}

}  // namespace sph
