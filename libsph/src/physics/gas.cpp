// Ideal gases: density from the places of the particles, energy from compression, viscosity and conduction.
#include <algorithm>
#include <cmath>

#include "physics/for_rows.hpp"
#include "physics/gas_kernel.hpp"
#include "sph/physics.hpp"

namespace sph {
namespace {

double trace_of(const double* matrix, std::size_t d) {
  double t = 0;
  for (std::size_t a = 0; a < d; ++a) t += matrix[a * (d + 1)];
  return t;
}

std::size_t width_of_moments(std::size_t d) { return 2 + d * (d + 1) / 2 + d * d; }

}  // namespace

// One step, positions advanced: density and what compression does to the energy, walls, forces with their
// heat, kick and heat. The forces derive from the energy of compression, so that the step is symplectic but
// for its viscosity.
void Physics::build_gas() {
  add_sums("density", {Term::number_density, Term::gas_moments});
  add_update("compression",
             {Field::density, Field::specific_energy, Field::pressure, Field::sound_speed,
              Field::smoothing_length, Field::kernel_correction, Field::velocity_gradient},
             [this](Particles& p, const RowRanges& ranges, const GlobalState& global) {
               update_gas(p, ranges, global);
             });
  plan_.start = plan_.sums;
  fields_ |= FieldSet{Field::smoothing_length, Field::kernel_correction, Field::velocity_gradient};
  if (scene_->has_kind(GroupKind::wall)) add_walls(false);
  add_sums("forces", {Term::gas_pressure, Term::viscosity, Term::shock_viscosity, Term::shock_heating});
}

// N = V^-1 spacing^D is wanted at a width s (h of the particle over that of the scene) with N s^D = 1. One
// step of Newton's method on g = N s^D - 1, from the width of the step before, gives N to second order, which
// is what the volume is taken from.
void Physics::update_gas(Particles& p, const RowRanges& ranges, const GlobalState& global) const {
  const auto d = static_cast<std::size_t>(p.dim());
  const std::size_t moments = width_of_moments(d);
  double* rho = p.data<Field::density>();
  double* energy = p.data<Field::specific_energy>();
  double* h = p.data<Field::smoothing_length>();
  double* correction = p.data<Field::kernel_correction>();
  double* gradient = p.data<Field::velocity_gradient>();
  const double* sums = p.data<Field::number_density>();
  const double* more = p.data<Field::gas_moments>();
  const double* mass = p.data<Field::mass>();
  const auto* group = p.data<Field::group>();
  for_movers(ranges, [&](std::size_t i) {
    const double width = h[i] * row_scale_.inverse_h;
    const GasKernel kernel =
        gas_kernel({width, gradient_factor_ * scene_->smoothing_length, kernel_at_zero_, sums[2 * i],
                    sums[2 * i + 1], more[i * moments], more[i * moments + 1]},
                   static_cast<int>(d), scene_->least_growth, scene_->largest_growth);
    if (!(kernel.open > 0)) find_fault(p, i, global, "is inside a wall; reduce time.cfl or time.dt");
    const double before = rho[i];
    rho[i] = mass[i] * row_scale_.inverse_volume * kernel.number;
    h[i] = kernel.width * scene_->smoothing_length;
    correction[i] = kernel.correction;
    // At the start there was no density before.
    if (before > 0)
      energy[i] = IdealGas{scene_->groups[group[i]].heat_ratio}.compressed(energy[i], rho[i] / before);
    if (!(energy[i] > 0)) find_fault(p, i, global, "has no energy left; reduce time.cfl or time.dt");
    if (d == 2)
      solve_gradient<2>(more + i * moments + 2, row_scale_.inverse_h, gradient + 4 * i);
    else
      solve_gradient<3>(more + i * moments + 2, row_scale_.inverse_h, gradient + 9 * i);
    derive(p, i, i + 1);
  });
}

// What lists bear before kernels have grown out of them.
constexpr double room_to_grow = 1.2;

const std::vector<double>& Physics::find_reaches(const Particles& p) {
  if (!gas_) return listed_;
  listed_.resize(p.rows());
  const double* h = p.data<Field::smoothing_length>();
  const double radius = scene_->support() / scene_->smoothing_length;
  for (std::size_t i = 0; i < listed_.size(); ++i)
    listed_[i] = std::fmin(radius * room_to_grow * h[i], scene_->list_range());
  return listed_;
}

double Physics::growth_since_listed(const Particles& p) const {
  double most = 0;
  const double* h = p.data<Field::smoothing_length>();
  const double radius = scene_->support() / scene_->smoothing_length;
  for (std::size_t i = 0; i < (listed_.empty() ? 0 : p.owned()); ++i)
    most = std::fmax(most, std::fmin(radius * fastest_growth * h[i], scene_->list_range()) / listed_[i]);
  return most;
}

// Kernels that grow are not let grow faster than lists and the sums of one step bear.
constexpr double growth_in_a_step = 0.05;

// The kick takes from the motion the work of the viscous forces on the mean of the velocities before and
// after it. Their heat was summed with those before: what is missing, dt/2 a.F_visc, is taken from the
// particle itself. A step compresses with the pressure that was before the heat at its start and with that
// after it at its end: heat belongs to its middle, and is what it would have been there. So energy is
// conserved to second order.
void Physics::heat(Particles& p, const RowRanges& ranges, const GlobalState& global,
                   StepMaxima& maxima) const {
  double* energy = p.data<Field::specific_energy>();
  const double* heating = p.data<Field::heating>();
  const double* force = p.data<Field::force>();
  const double* mass = p.data<Field::mass>();
  const double* gradient = p.data<Field::velocity_gradient>();
  const auto* group = p.data<Field::group>();
  const std::size_t d = static_cast<std::size_t>(p.dim());
  const double fastest_in_time = scene_->time.cfl * scene_->smoothing_length / growth_in_a_step;
  for (RowClass c : {RowClass::interior_movers, RowClass::boundary_movers}) {
    const RowRange& r = ranges[static_cast<std::size_t>(c)];
    for (std::size_t i = r.first; i < r.last; ++i) {
      const double* own = heating + i * (1 + d);
      double power = own[0];
      for (std::size_t a = 0; a < d; ++a)
        power -= 0.5 * global.dt * (force[i * d + a] / mass[i]) * own[1 + a];
      const double expansion = trace_of(gradient + i * d * d, d);
      const double later = 1 - 0.5 * (scene_->groups[group[i]].heat_ratio - 1) * global.dt * expansion;
      maxima.sound = larger(fastest_in_time / static_cast<double>(d) * expansion, maxima.sound);
      energy[i] += global.dt * (power / mass[i]) / std::fmin(std::fmax(later, 0.7), 1.4);
      if (!(energy[i] > 0)) find_fault(p, i, global, "has no energy left; reduce time.cfl or time.dt");
    }
    derive(p, r.first, r.last);
    look_at_gas(p, r.first, r.last, maxima);
  }
}

// Of gases `sound` is h times the largest (c + |v|) / h_i, and `viscosity` takes h_i for h likewise.
void Physics::look_at_gas(const Particles& p, std::size_t first, std::size_t last, StepMaxima& maxima) const {
  const auto d = static_cast<std::size_t>(p.dim());
  const double* rho = p.data<Field::density>();
  const double* energy = p.data<Field::specific_energy>();
  const double* v = p.data<Field::velocity>();
  const double* h = p.data<Field::smoothing_length>();
  const auto* group = p.data<Field::group>();
  for (std::size_t i = first; i < last; ++i) {
    const Group& g = scene_->groups[group[i]];
    if (g.kind == GroupKind::wall) continue;
    double square = 0;
    for (std::size_t a = 0; a < d; ++a) square += v[i * d + a] * v[i * d + a];
    const double finer = scene_->smoothing_length / h[i];
    const double sound = IdealGas{g.heat_ratio}.sound_speed(energy[i]);
    maxima.sound = larger((sound + std::sqrt(square)) * finer, maxima.sound);
    if (rho[i] > 0) maxima.viscosity = std::fmax(maxima.viscosity, g.viscosity / rho[i] * (finer * finer));
  }
}

}  // namespace sph
