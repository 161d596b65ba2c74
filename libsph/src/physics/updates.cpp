// Local updates: what happens to one particle between two passes, from its own values and pair sums alone.
#include <cmath>

#include "physics/for_rows.hpp"
#include "sph/fixed_point.hpp"
#include "sph/physics.hpp"
#include "sph/stress_update.hpp"

namespace sph {
namespace {

double trace_of(const double* matrix, std::size_t d) {
  double t = 0;
  for (std::size_t a = 0; a < d; ++a) t += matrix[a * (d + 1)];
  return t;
}

}  // namespace

void Physics::derive(Particles& p, std::size_t first, std::size_t last) const {
  const double* rho = p.data<Field::density>();
  const auto* group = p.data<Field::group>();
  double* pressure = p.data<Field::pressure>();
  double* sound = p.data<Field::sound_speed>();
  double* psi = p.data<Field::void_fraction>();
  const double* gas = p.data<Field::gas_content>();
  const double* energy = p.data<Field::specific_energy>();
  for (std::size_t i = first; i < last; ++i) {
    const Group& g = scene_->groups[group[i]];
    if (g.kind == GroupKind::wall && scene_->formulation == Formulation::conservative) {
      if (sound != nullptr) sound[i] = groups_.sound_speed[group[i]];
      if (psi != nullptr) psi[i] = 0;
      pressure[i] = 0;  // until it is extrapolated from the fluid; a checkpoint does not have it
      continue;
    }
    double absolute, c = groups_.sound_speed[group[i]], void_fraction = 0;
    if (g.eos == EosKind::bubbly) {
      const BubblyEos eos = gas[i] == g.gas_content ? bubbly_[group[i]] : bubbly_eos(g, gas[i]);
      absolute = eos.pressure(rho[i]);
      c = eos.sound_speed(absolute);
      void_fraction = eos.void_fraction(absolute);
    } else if (g.eos == EosKind::ideal_gas) {
      const IdealGas eos{g.heat_ratio};
      absolute = eos.pressure(rho[i], energy[i]);
      c = eos.sound_speed(energy[i]);
    } else {
      absolute = g.bulk_modulus * ((rho[i] - g.density) / g.density);
    }
    pressure[i] = absolute - scene_->surface_pressure;
    if (sound != nullptr) sound[i] = c;
    if (psi != nullptr) psi[i] = void_fraction;
  }
}

// A flow that disorders its particles seems compressed to their sums of div v, and the shifting that orders
// them again is in no sum: the mean density of a closed box would rise, or fall, without end. But the box is
// as large as ever, so densities are scaled to fill it.
double Physics::filling(const GlobalState& global) {
  const FluidVolume& v = global.fluid_volume;
  return v.start == v.now ? 1.0 : static_cast<double>(v.now) / static_cast<double>(v.start);
}

std::int64_t Physics::fluid_volume(const Particles& p) const {
  if (!scene_->terms.shifting || scene_->open) return 0;
  const double* mass = p.data<Field::mass>();
  const double* rho = p.data<Field::density>();
  const auto* group = p.data<Field::group>();
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < p.owned(); ++i)
    if (!is_wall(group[i])) sum += round_to_quanta(mass[i] / rho[i] * (row_scale_.inverse_volume * 0x1p26));
  return sum;
}

void Physics::update_movers(Particles& p, std::size_t first, std::size_t last,
                            const GlobalState& global) const {
  const double dt = global.dt, fill = filling(global);
  double* rho = p.data<Field::density>();
  const double* diffusion = p.data<Field::diffusion>();
  const double* divergence = p.data<Field::divergence>();
  const double* gradient = p.data<Field::velocity_gradient>();
  double* stress = p.data<Field::stress>();
  const auto* group = p.data<Field::group>();
  const std::size_t d = static_cast<std::size_t>(p.dim()), components_of_stress = d * (d + 1) / 2;
  for (std::size_t i = first; i < last; ++i) {
    const Group& g = scene_->groups[group[i]];
    double div = 0;
    if (divergence != nullptr) {
      div = divergence[i];
    } else {
      div = trace_of(gradient + i * d * d, d);
      if (g.kind == GroupKind::solid) {
        if (d == 2)
          update_deviator<2>(stress + i * components_of_stress, gradient + i * 4, g.shear_modulus, dt);
        else
          update_deviator<3>(stress + i * components_of_stress, gradient + i * 9, g.shear_modulus, dt);
      }
    }
    const double exchanged = g.kind == GroupKind::solid ? 0.0 : diffusion[i];
    rho[i] = (rho[i] + dt * (exchanged - rho[i] * div)) * fill;
  }
  derive(p, first, last);
  if (!bulk_viscous_) return;
  // Second viscosity, Ida eq. (9): an excess pressure -zeta div v in the forces of this step only.
  double* pressure = p.data<Field::pressure>();
  for (std::size_t i = first; i < last; ++i)
    pressure[i] -= scene_->groups[group[i]].bulk_viscosity *
                   (divergence != nullptr ? divergence[i] : trace_of(gradient + i * d * d, d));
}

void Physics::update_walls(Particles& p, const RowRanges& ranges, const GlobalState& global) const {
  const std::size_t d = static_cast<std::size_t>(p.dim());
  const double* sums = p.data<Field::wall_sums>();
  const double* by_density = p.data<Field::wall_sums_by_density>();
  double* pressures = p.data<Field::wall_pressures>();
  double* pressure = p.data<Field::pressure>();
  double* mirror = p.data<Field::wall_mirror>();
  double* v = p.data<Field::velocity>();
  const auto* group = p.data<Field::group>();
  for (RowClass c : {RowClass::interior_walls, RowClass::boundary_walls}) {
    const RowRange& r = ranges[static_cast<std::size_t>(c)];
    for (std::size_t i = r.first; i < r.last; ++i) {
      const double* s = sums + i * (2 + 2 * d);
      const Group& g = scene_->groups[group[i]];
      const bool wet = s[0] > 0;
      pressure[i] = wet ? s[1] / s[0] : 0.0;
      if (pressures != nullptr)
        for (std::size_t k = 0; k < 2; ++k) {
          const double* of = by_density + 4 * i + 2 * k;
          pressures[2 * i + k] = of[0] > 0 ? of[1] / of[0] : 0.0;
        }
      if (mirror != nullptr && global.step == 0) {
        double square = 0;
        for (std::size_t a = 0; a < d; ++a) square += s[2 + d + a] * s[2 + d + a];
        mirror[i] = wet ? (*mirror_)(std::sqrt(square) / s[0], s[0]) : 1.0;
      }
      // Between a fluid and a wall that slips the viscous force is then that of its own mean: no shear. The
      // velocity across the wall is taken along, though its mirror image would be the exact one: it is small,
      // because the continuity sum sees the wall at rest, and changes the normal viscous stress alone, which
      // the pressure balances.
      for (std::size_t a = 0; a < d; ++a) {
        const double mean = wet ? s[2 + a] / s[0] : g.wall_velocity[a];
        v[i * d + a] = g.slip ? mean : g.wall_velocity[a] - mirror[i] * (mean - g.wall_velocity[a]);
      }
    }
  }
}

// Fluid that is torn keeps its density while its neighbours part, so that no pressure stops it before a wall,
// and one below 0 draws it in. Here walls stop it, without spring or rebound: where the way is y to 0.4
// spacings before a face, no particle moves towards it faster than c y / 10h, and beyond that not at all,
// whatever the other forces. So walls take energy and never give any, at any time step; what is behind a face
// comes out by its pressure. In corners, where the walls' gradient is less than their share tells, rest has a
// larger share.
void Physics::hold_off(Particles& p, const RowRanges& ranges, double dt) const {
  constexpr double approach = 0.1, flat = 0.96, inside = 0.05;
  const auto d = static_cast<std::size_t>(p.dim());
  const double h = scene_->smoothing_length, before = 0.4 * scene_->spacing / h;
  const double* share = p.data<Field::wall_share>();
  const double* mass = p.data<Field::mass>();
  const double* v = p.data<Field::velocity>();
  const double* sound = p.data<Field::sound_speed>();
  const auto* group = p.data<Field::group>();
  double* force = p.data<Field::force>();
  for_movers(ranges, [&](std::size_t i) {
    const double* s = share + i * (d + 1);
    if (!(s[d] > 0) || scene_->groups[group[i]].kind != GroupKind::fluid) return;
    const Double3 body = body_acceleration(p, i);
    double square = 0, way = 0;
    for (std::size_t a = 0; a < d; ++a) {
      square += s[a] * s[a];
      way += (v[i * d + a] + dt * (force[i * d + a] / mass[i] + body[a])) * s[a];
    }
    const double length = std::sqrt(square);
    if (!(h * length > inside)) return;
    const double straight = h * length / wall_distance_->gradient(h * s[d]);
    const double face = straight > flat ? -before : wall_distance_->depth_in_corner();
    const double c = sound != nullptr ? sound[i] : groups_.sound_speed[group[i]];
    const double most = c * std::fmax(approach * (face - wall_distance_->depth(h * s[d])), 0.0);
    const double excess = way / length - most;
    if (!(excess > 0)) return;
    for (std::size_t a = 0; a < d; ++a) force[i * d + a] -= mass[i] * excess / dt * (s[a] / length);
  });
}

// A flow that is 0 at the wall and 1 at the particle, straight between: its gradient is the normal over the
// distance, in units of 1/h. Particles nearer than a quarter of their spacing count as being there. Where
// walls on both sides leave less than half of the gradient that belongs to their share there is no normal: 0.
// Of what they hardly reach any will do.
void Physics::find_walls(Particles& p, const RowRanges& ranges) const {
  constexpr double nearest = 0.25, flat = 0.5, little = 0.01;
  const auto d = static_cast<std::size_t>(p.dim());
  const double h = scene_->smoothing_length;
  const double* share = p.data<Field::wall_share>();
  double* slope = p.data<Field::wall_slope>();
  for_movers(ranges, [&](std::size_t i) {
    const double* s = share + i * (d + 1);
    double square = 0;
    for (std::size_t a = 0; a < d; ++a) square += s[a] * s[a];
    const double length = std::sqrt(square), away = (*wall_distance_)(h * s[d]);
    const bool normal =
        length > 0 && (h * s[d] < little || h * length >= flat * wall_distance_->gradient(h * s[d]));
    const double factor = normal ? -1 / (std::fmax(away, nearest * scene_->spacing / h) * length) : 0.0;
    for (std::size_t a = 0; a < d; ++a) slope[i * d + a] = factor * s[a];
  });
}

void Physics::update_ida(Particles& p, std::size_t first, std::size_t last, double dt) const {
  const std::size_t d = static_cast<std::size_t>(p.dim()), n = d * (d + 1) / 2;
  const double* gradient = p.data<Field::velocity_gradient>();
  double* rho = p.data<Field::density>();
  double* stress = p.data<Field::stress>();
  const auto* group = p.data<Field::group>();
  for (std::size_t i = first; i < last; ++i) rho[i] -= dt * rho[i] * trace_of(gradient + i * d * d, d);
  derive(p, first, last);
  for (std::size_t i = first; i < last; ++i) {
    const Group& g = scene_->groups[group[i]];
    double* s = stress + i * n;
    const double* grad = gradient + i * d * d;
    if (g.kind == GroupKind::solid) {
      // (11) less its isotropic part: -K div v is the rate of -p in (10), so lambda - K = -2/3 mu is left.
      if (d == 2)
        update_hooke_literal<2>(s, grad, -2.0 / 3.0 * g.shear_modulus, g.shear_modulus, dt);
      else
        update_hooke_literal<3>(s, grad, -2.0 / 3.0 * g.shear_modulus, g.shear_modulus, dt);
      continue;
    }
    const double div = trace_of(grad, d);
    for (std::size_t a = 0; a < d; ++a)
      for (std::size_t b = a; b < d; ++b) {
        const std::size_t k = a == b ? a : d + a + b - 1;
        s[k] = g.viscosity * (grad[a * d + b] + grad[b * d + a]) + (a == b ? g.bulk_viscosity * div : 0.0);
      }
  }
}

StepMaxima Physics::maxima_at_start(const Particles& p) const {
  const std::size_t d = static_cast<std::size_t>(p.dim());
  const double* v = p.data<Field::velocity>();
  double speed2 = 0;
  StepMaxima maxima;
  for (std::size_t i = 0; i < p.owned(); ++i) {
    double v2 = 0;
    for (std::size_t a = 0; a < d; ++a) v2 += v[i * d + a] * v[i * d + a];
    speed2 = v2 > speed2 ? v2 : speed2;
  }
  if (gas_) look_at_gas(p, 0, p.owned(), maxima);
  maxima.speed = std::sqrt(speed2);
  return maxima;
}

void Physics::advance(Particles& p, const RowRanges& ranges, double dt) const {
  const std::size_t d = static_cast<std::size_t>(p.dim());
  std::int64_t* x = p.data<Field::position>();
  std::int64_t* u = p.data<Field::displacement>();
  const double* v = p.data<Field::velocity>();
  const double quanta_per_metre = 1 / scale_.quantum;
  for (RowClass c : {RowClass::interior_movers, RowClass::boundary_movers}) {
    const RowRange& r = ranges[static_cast<std::size_t>(c)];
    for (std::size_t k = r.first * d; k < r.last * d; ++k)
      x[k] += round_to_quanta(v[k] * dt * quanta_per_metre);
    if (u == nullptr) continue;
    for (std::size_t k = r.first * d; k < r.last * d; ++k)
      u[k] += round_to_quanta(v[k] * dt * quanta_per_metre);
  }
}

Double3 Physics::body_acceleration(const Particles& p, std::size_t i) const {
  const auto d = static_cast<std::size_t>(p.dim());
  const std::int64_t* x = p.data<Field::position>();
  const double pull = scene_->central_pull, control = tension_control(p, i);
  Double3 acceleration = scene_->gravity;
  for (std::size_t a = 0; a < d; ++a) {
    if (pull != 0) acceleration[a] -= pull * (scale_.metres(x[i * d + a]) - scene_->pull_centre[a]);
    if (control != 0) acceleration[a] += control * p.data<Field::spread>()[i * (d + 2) + a];
  }
  return acceleration;
}

StepMaxima Physics::integrate(Particles& p, const RowRanges& ranges, const GlobalState& global) const {
  const std::size_t d = static_cast<std::size_t>(p.dim());
  const double dt = global.dt;
  double* v = p.data<Field::velocity>();
  const double* force = p.data<Field::force>();
  const double* mass = p.data<Field::mass>();
  const auto* group = p.data<Field::group>();
  const double* h = p.data<Field::smoothing_length>();
  double speed2 = 0, acceleration2 = 0;
  for_movers(ranges, [&](std::size_t i) {
    const double inverse_mass = 1 / mass[i];
    const Double3 body = body_acceleration(p, i);
    double v2 = 0, a2 = 0;
    for (std::size_t a = 0; a < d; ++a) {
      const double acceleration = force[i * d + a] * inverse_mass + body[a];
      v[i * d + a] += acceleration * dt;
      a2 += acceleration * acceleration;
      v2 += v[i * d + a] * v[i * d + a];
    }
    // How far it takes a particle is counted in its own h.
    const double finer = h != nullptr ? scene_->smoothing_length / h[i] : 1.0;
    speed2 = larger(v2, speed2);
    acceleration2 = larger(a2 * (finer * finer), acceleration2);
  });
  for (RowClass c : {RowClass::interior_walls, RowClass::boundary_walls}) {
    const RowRange& r = ranges[static_cast<std::size_t>(c)];
    for (std::size_t i = r.first; i < r.last; ++i)
      for (std::size_t a = 0; a < d; ++a) v[i * d + a] = scene_->groups[group[i]].wall_velocity[a];
  }
  if (scene_->terms.shifting) shift(p, ranges, global);
  if (bulk_viscous_) for_movers(ranges, [&](std::size_t i) { derive(p, i, i + 1); });
  if (!transitions_.empty()) for_movers(ranges, [&](std::size_t i) { change_group(p, i); });
  StepMaxima maxima{std::sqrt(speed2), std::sqrt(acceleration2), fluid_volume(p)};
  if (scene_->terms.shifting) maxima.motion = motion_sums(p, global);
  if (gas_) heat(p, ranges, global, maxima);
  if (p.has(Field::velocity_mean)) average(p, global);
  return maxima;
}

// a += dt/T (f - a), T the time since the start until that is the scene's window: from the plain mean to an
// exponential one. Nothing reads it but output.
void Physics::average(Particles& p, const GlobalState& global) const {
  const std::size_t d = static_cast<std::size_t>(p.dim());
  const double weight = global.dt / std::fmin(scene_->output.average_time, global.time + global.dt);
  const double w = std::fmin(weight, 1.0);
  const auto follow = [&](double* mean, const double* value, std::size_t n) {
    for (std::size_t k = 0; k < n; ++k) mean[k] += w * (value[k] - mean[k]);
  };
  follow(p.data<Field::velocity_mean>(), p.data<Field::velocity>(), p.owned() * d);
  follow(p.data<Field::pressure_mean>(), p.data<Field::pressure>(), p.owned());
}

// Fragmentation (paper, 4.3): a bubbly particle whose gas fraction exceeds psi_f joins the spray, for good.
// Mass, momentum and gas stay with the particle; only its constitutive constants change.
void Physics::change_group(Particles& p, std::size_t i) const {
  auto* group = p.data<Field::group>();
  const Group& g = scene_->groups[group[i]];
  if (g.fragments_to >= 0 && p.data<Field::void_fraction>()[i] > *g.fragmentation_void_fraction)
    group[i] = static_cast<std::uint32_t>(g.fragments_to);
}

}  // namespace sph
