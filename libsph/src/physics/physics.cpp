#include "sph/physics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>

#include "physics/viscosity_solver.hpp"
#include "sph/grains.hpp"
#include "sph/kernels.hpp"

namespace sph {
namespace {

double power(double x, int n) {
  double p = 1;
  for (int k = 0; k < n; ++k) p *= x;
  return p;
}

struct KernelNumbers {
  double radius;          ///< support / h
  double normalisation;   ///< alpha_D
  double w_spacing;       ///< unnormalised w(spacing / h)
  double w_zero;          ///< unnormalised w(0)
  double second, fourth;  ///< -1/D sum V W' r and -1/D sum V W' r (r/h)^2 over the lattice
};

template <class Kernel>
KernelNumbers numbers(int dim, double q) {
  const auto in = [q]<int D>(std::integral_constant<int, D>) {
    KernelNumbers k{Kernel::radius,
                    Kernel::template normalisation<D>,
                    Kernel::template value<D>(q),
                    Kernel::template value<D>(0.0),
                    0,
                    0};
    const int reach = static_cast<int>(Kernel::radius / q) + 1, across = D == 3 ? reach : 0;
    for (int a = -reach; a <= reach; ++a)
      for (int b = -reach; b <= reach; ++b)
        for (int c = -across; c <= across; ++c) {
          const double square = (a * a + b * b + c * c) * (q * q), r = std::sqrt(square);
          const double term = -(power(q, D) * k.normalisation / D) * Kernel::template slope<D>(r) * r;
          k.second += term;
          k.fourth += term * square;
        }
    return k;
  };
  return dim == 2 ? in(std::integral_constant<int, 2>{}) : in(std::integral_constant<int, 3>{});
}

KernelNumbers numbers(const Scene& scene) {
  const double q = scene.spacing / scene.smoothing_length;
  switch (scene.kernel) {
    case KernelShape::wendland_c2:
      return numbers<WendlandC2>(scene.dim, q);
    case KernelShape::wendland_c4:
      return numbers<WendlandC4>(scene.dim, q);
    case KernelShape::quintic:
      break;
  }
  return numbers<Quintic>(scene.dim, q);
}

/// Of the interface with tension; fragments stay on the side of what they broke from.
double side_of(const Scene& scene, int group) {
  const auto on = [&](int of) {
    return group == of || (of >= 0 && group == scene.groups[static_cast<std::size_t>(of)].fragments_to);
  };
  const std::array<int, 2>& between = scene.terms.surface_tension.between;
  return on(between[0]) ? 1 : on(between[1]) ? -1 : 0;
}

/// The density that parts lighter fluids from heavier ones: the lower end of the largest gap.
double density_divide(const Scene& scene) {
  std::vector<double> densities;
  for (const Group& g : scene.groups)
    if (g.kind == GroupKind::fluid) densities.push_back(g.density);
  std::sort(densities.begin(), densities.end());
  std::size_t at = 0;
  for (std::size_t k = 0; k + 1 < densities.size(); ++k)
    if (densities[k + 1] * densities[at] > densities[k] * densities[at + 1]) at = k;
  return densities.empty() ? 0.0 : densities[at];
}
/// Of two layers in contact over that of the material: softer, or they would ask for a shorter time step.
constexpr double contact_stiffness = 0.5;

}  // namespace

PositionScale position_scale(const Scene& scene) {
  double extent = 0;
  for (int a = 0; a < scene.dim; ++a)
    extent = std::max({extent, std::abs(scene.lower[static_cast<std::size_t>(a)]),
                       std::abs(scene.upper[static_cast<std::size_t>(a)])});
  PositionScale scale;
  // The next power of two above both bounds. A bond of a body that turns upside down is displaced by its
  // length then and now.
  const double longest = scene.total_lagrangian() ? scene.support() + scene.list_range() : scene.list_range();
  scale.quantum = std::ldexp(1.0, std::max(std::ilogb(extent) + 1 - 60, std::ilogb(longest) + 1 - 50));
  for (std::size_t a = 0; a < 3; ++a) scale.origin[a] = scale.quanta(scene.lower[a]);
  return scale;
}

// 2^29 units across the support, so that its square and the skin stay within 31 bits.
int row_position_shift(const Scene& scene, const PositionScale& scale) {
  const double longest = scene.total_lagrangian() ? scene.support() : scene.list_range();
  return std::max(std::ilogb(longest / scale.quantum) + 1 - 29, 0);
}

std::int64_t PositionScale::quanta(double metres) const {
  // |metres / quantum| < 2^62, and the division by a power of two is exact.
  return static_cast<std::int64_t>(std::nearbyint(metres / quantum));
}

Physics::Physics(const Scene& scene, const PositionScale& scale)
    : scene_(&scene),
      scale_(scale),
      gas_(scene.has_eos(EosKind::ideal_gas)),
      surface_(scene.kernel, scene.dim) {
  if (scene.of_grains()) {
    fields_ = grain_fields(scene);  // no passes: Grains has the rest
    return;
  }
  set_sph_constants();
  if (scene.formulation == Formulation::ida)
    build_ida();
  else if (gas_)
    build_gas();
  else if (scene.total_lagrangian())
    build_total_lagrangian();
  else
    build_conservative();
}

void Physics::set_sph_constants() {
  const Scene& scene = *scene_;
  const KernelNumbers kernel = numbers(scene);
  const double h = scene.smoothing_length;
  const double volume = power(scene.spacing, scene.dim);
  const double slope = kernel.normalisation / power(h, scene.dim + 1);
  gradient_factor_ = volume * slope;
  force_factor_ = volume * volume * slope;
  kernel_at_zero_ = kernel.w_zero;
  own_concentration_ = kernel.w_zero * gradient_factor_ * h;
  diffusion_factor_ = 2 * scene.terms.density_diffusion * h * (volume * slope / h);

  row_scale_.position_shift = row_position_shift(scene, scale_);
  const double unit = scene.precision == Precision::mixed
                          ? std::ldexp(scale_.quantum, row_scale_.position_shift)
                          : scale_.quantum;
  row_scale_.position_unit = unit / h;
  row_scale_.inverse_volume = 1 / volume;
  row_scale_.inverse_h = 1 / h;
  row_scale_.quantum = scale_.quantum;
  row_scale_.pull = scene.central_pull;
  for (std::size_t a = 0; a < 3; ++a) row_scale_.pull_centre[a] = scene.pull_centre[a];

  const double divide = density_divide(scene);
  for (const Group& g : scene.groups) {
    groups_.viscosity.push_back(g.viscosity);
    // p-waves are the fastest in a solid
    const double modulus = g.bulk_modulus + (g.kind == GroupKind::solid ? 4.0 / 3.0 * g.shear_modulus : 0.0);
    groups_.sound_speed.push_back(std::sqrt(modulus / g.density));
    groups_.heavy.push_back(g.kind == GroupKind::fluid && g.density > divide ? 1.0 : 0.0);
    groups_.side.push_back(side_of(scene, static_cast<int>(&g - scene.groups.data())));
    groups_.mover.push_back(g.kind == GroupKind::wall ? 0.0 : 1.0);
    groups_.shears.push_back(g.kind == GroupKind::fluid ? 0.0 : 1.0);
    groups_.density.push_back(g.density);
    const std::size_t body = g.clamps < 0 ? groups_.body.size() : static_cast<std::size_t>(g.clamps);
    groups_.body.push_back(static_cast<double>(body));
    groups_.modulus.push_back(scene.groups[body].bulk_modulus + 4.0 / 3.0 * scene.groups[body].shear_modulus);
    bulk_viscous_ = bulk_viscous_ || g.bulk_viscosity > 0;
    if (g.fragments_to >= 0) transitions_.push_back(static_cast<int>(&g - scene.groups.data()));
    bubbly_.push_back(bubbly_eos(g, g.gas_content));
  }
  const auto fluid = std::find_if(scene.groups.begin(), scene.groups.end(),
                                  [](const Group& g) { return g.kind != GroupKind::wall; });
  groups_.surface_tension = scene.terms.surface_tension.coefficient;
  constants_ = {};
  // Along a periodic axis a body force drives a flow: no hydrostatic pressure balances it.
  for (std::size_t a = 0; a < 3; ++a) constants_.gravity[a] = scene.periodic[a] ? 0.0 : scene.gravity[a] * h;
  constants_.laplacian = 1 / kernel.second;
  constants_.symmetric = (scene.dim + 2) / kernel.fourth;
  constants_.viscosity = fluid->viscosity / h * constants_.laplacian;
  constants_.density = fluid->density;
  constants_.inverse_sound_speed = 1 / std::sqrt(fluid->bulk_modulus / fluid->density);
  constants_.artificial_viscosity = scene.terms.artificial_viscosity;
  constants_.quadratic_viscosity = scene.terms.quadratic_viscosity;
  constants_.conduction = scene.terms.conduction;
  constants_.inverse_w_spacing = 1 / kernel.w_spacing;
  constants_.bond_range = scene.list_range() / h;
  constants_.hourglass = scene.terms.hourglass;
  constants_.contact_range = scene.spacing / h;
  // k over min(M_i, M_j), terms/body_contact.hpp; forces are multiplied by force_factor_ later.
  const double contact = contact_stiffness * power(scene.spacing, scene.dim) / (h * h);
  constants_.contact_force = contact * h / force_factor_;
  constants_.contact_energy = 0.25 * contact * h * h;

  fields_ = {Field::id,   Field::position, Field::velocity, Field::density,
             Field::mass, Field::group,    Field::pressure, Field::force};
  if (scene.has_eos(EosKind::bubbly))
    fields_ |= FieldSet{Field::sound_speed, Field::void_fraction, Field::gas_content};
  if (gas_) fields_ |= FieldSet{Field::sound_speed, Field::specific_energy};
  if (scene.has_kind(GroupKind::solid) || scene.formulation == Formulation::ida)
    fields_ |= FieldSet{Field::stress};
  if (scene.output.average_time > 0) fields_ |= output_averages;
}

void Physics::add_pass(std::string name, const std::vector<Term>& terms, bool movers, bool walls) {
  const Fusion& fusion = find_fusion(scene_->dim, scene_->precision, scene_->kernel, terms);
  fields_ |= fusion.writes;
  passes_.push_back({std::move(name), &fusion, movers, walls, fields_behind(fusion.values), {}, {}, {}});
}

// One step, positions advanced: kinematics (density and stress from the velocities), walls (extrapolation
// from the new pressures), forces, kick. The density is advanced with the velocity of the half step before
// the kick that uses it: symplectic, stable to c dt/h well above 0.8 (accuracy.md 0.3).
void Physics::build_conservative() {
  const Scene& s = *scene_;
  std::size_t movers = 0;
  bool uniform_viscosity = true;
  for (const Group& g : s.groups) {
    if (g.kind != GroupKind::wall) ++movers;
    uniform_viscosity = uniform_viscosity && g.viscosity == s.groups[0].viscosity;
  }
  const bool walls = s.has_kind(GroupKind::wall), solid = s.has_kind(GroupKind::solid);
  const bool slips = solid && s.has_kind(GroupKind::fluid);
  const bool single = movers == 1 && !walls && !s.has_eos(EosKind::bubbly);
  const bool weighted = s.terms.pressure_weights == PressureWeights::density;
  std::vector<Term> kinematics{slips      ? Term::slipping_gradient
                               : solid    ? Term::velocity_gradient
                               : weighted ? Term::weighted_divergence
                                          : Term::divergence,
                               s.central_pull > 0              ? Term::pulled_density_diffusion
                               : single && !solid && !weighted ? Term::uniform_density_diffusion
                                                               : Term::density_diffusion};
  if (s.terms.shifting) kinematics.push_back(Term::shifting);
  const bool tension = s.terms.surface_tension.coefficient > 0;
  if (tension) kinematics.push_back(Term::colour_gradient);
  add_pass("kinematics", kinematics, true, false);
  passes_.back().update = [this](Particles& p, const RowRanges& ranges, const GlobalState& global) {
    for (RowClass c : {RowClass::interior_movers, RowClass::boundary_movers}) {
      const RowRange& r = ranges[static_cast<std::size_t>(c)];
      update_movers(p, r.first, r.last, global);
    }
  };
  passes_.back().changes = {Field::density, Field::stress, Field::pressure, Field::sound_speed};

  if (weighted) fields_ |= FieldSet{Field::wall_pressures};
  if (walls) add_walls(weighted);
  const bool jump = tension && s.terms.surface_tension.form == TensionForm::jump;
  if (jump) add_curvature();

  const bool symmetric = s.terms.viscosity == ViscosityForm::symmetric;
  const bool uniform = uniform_viscosity && !solid && !weighted && !tension && !symmetric;
  std::vector<Term> forces{slips      ? Term::slipping_stress
                           : solid    ? Term::stress_divergence
                           : weighted ? Term::weighted_pressure
                                      : Term::pressure};
  if (!s.terms.implicit_viscosity)
    forces.push_back(uniform     ? Term::uniform_viscosity
                     : symmetric ? Term::symmetric_viscosity
                                 : Term::viscosity);
  if (tension)
    forces.push_back(!jump      ? Term::surface_tension
                     : weighted ? Term::weighted_tension_jump
                                : Term::tension_jump);
  if (s.terms.artificial_viscosity > 0) forces.push_back(Term::artificial_viscosity);
  add_pass("forces", forces, true, false);
  if (walls && s.has_kind(GroupKind::fluid) && (s.terms.implicit_viscosity || s.free_surface))
    find_walls_nearby();
  if (s.terms.implicit_viscosity) build_implicit_viscosity(walls);
}

void Physics::add_walls(bool weighted) {
  if (std::any_of(scene_->groups.begin(), scene_->groups.end(),
                  [](const Group& g) { return g.kind == GroupKind::wall && !g.slip; })) {
    mirror_.emplace(*scene_);
    fields_ |= FieldSet{Field::wall_mirror};
  }
  std::vector<Term> terms{Term::wall_extrapolation};
  if (weighted) terms.push_back(Term::wall_extrapolation_by_density);
  add_pass("walls", terms, false, true);
  passes_.back().update = [this](Particles& p, const RowRanges& ranges, const GlobalState& global) {
    update_walls(p, ranges, global);
  };
  passes_.back().changes = {Field::pressure, Field::velocity, Field::wall_pressures, Field::wall_mirror};
}

// Only where fluid flies can it come into walls.
void Physics::find_walls_nearby() {
  wall_distance_.emplace(scene_->kernel, scene_->dim, scene_->spacing / scene_->smoothing_length);
  add_pass("wall distance", {Term::wall_share}, true, false);
  if (!scene_->free_surface) return;
  passes_.back().update = [this](Particles& p, const RowRanges& ranges, const GlobalState& global) {
    hold_off(p, ranges, global.dt);
  };
  passes_.back().changes = {Field::force};
}

// The paper's cycle: velocity gradient (10), density (8), pressure, stress (9) or (11) of every particle,
// walls included; then the force (6) on those that move.
void Physics::build_ida() {
  add_pass("gradient", {Term::ida_gradient}, true, true);
  passes_.back().update = [this](Particles& p, const RowRanges& ranges, const GlobalState& global) {
    for (const RowRange& r : ranges) update_ida(p, r.first, r.last, global.dt);
  };
  passes_.back().changes = {Field::density, Field::stress, Field::pressure, Field::sound_speed};
  std::vector<Term> forces{Term::ida_stress};
  if (scene_->terms.artificial_viscosity > 0) forces.push_back(Term::artificial_viscosity);
  add_pass("forces", forces, true, false);
}

FieldSet Physics::integrated() const {
  FieldSet changed{Field::velocity};
  if (scene_->terms.shifting) changed |= FieldSet{Field::position};
  if (bulk_viscous_) changed |= FieldSet{Field::pressure};
  if (gas_) changed |= FieldSet{Field::specific_energy, Field::pressure, Field::sound_speed};
  if (!transitions_.empty()) changed |= FieldSet{Field::group};
  return changed;
}

PassContext Physics::context(Particles& particles, const NeighbourLists& lists,
                             decomp::LargeVector<std::byte>& rows, double dt) const {
  TermConstants<double> constants = constants_;
  constants.half_step = 0.5 * dt / scene_->smoothing_length;
  return {&particles,       &lists,        &groups_,          row_scale_, constants,
          gradient_factor_, force_factor_, diffusion_factor_, &rows};
}

double Physics::time_step(const StepMaxima& maxima) const {
  if (scene_->time.dt) return *scene_->time.dt;
  const double h = scene_->smoothing_length;
  double fastest = maxima.sound, viscous = maxima.viscosity, bulk = 0;
  for (std::size_t g = 0; g < scene_->groups.size(); ++g) {
    // Of a gas that of now counts.
    if (maxima.sound == 0 || !gas_) fastest = std::max(fastest, groups_.sound_speed[g]);
    if (scene_->total_lagrangian() && is_wall(static_cast<std::uint32_t>(g))) continue;
    viscous = std::max(viscous, groups_.viscosity[g] / scene_->groups[g].density);
    bulk = std::max(bulk, scene_->groups[g].bulk_viscosity / scene_->groups[g].density);
  }
  const bool bonds = scene_->total_lagrangian();
  if (bonds || scene_->terms.viscosity == ViscosityForm::symmetric)
    viscous *= 3;  // nu (lap v + 2 grad div v)
  if (scene_->terms.implicit_viscosity) viscous = 0;
  viscous += bulk;
  if (!gas_) fastest += maxima.speed;  // of a gas it is in `sound`
  double dt = scene_->time.cfl * h / fastest;
  // Dashpots beside springs: the rates add.
  if (bonds && viscous > 0) dt = 1 / (1 / dt + viscous / (0.125 * h * h));
  if (viscous > 0) dt = std::min(dt, 0.125 * h * h / viscous);
  // Capillary waves as long as the layer is thick (Brackbill et al. 1992, eq. 61).
  if (const InterfaceTension& t = scene_->terms.surface_tension; t.coefficient > 0) {
    double density = 0;
    for (int k : t.between) density += 0.5 * scene_->groups[static_cast<std::size_t>(k)].density;
    dt = std::min(dt, 0.25 * std::sqrt(density * h * h * h / (2 * std::numbers::pi * t.coefficient)));
  }
  if (maxima.acceleration > 0) dt = std::min(dt, 0.25 * std::sqrt(h / maxima.acceleration));
  return dt;
}

// The margin covers the rounding to quanta.
double Physics::longest_advance(const GlobalState& global) const {
  return 1.0001 * global.max_speed * global.dt;
}

// Wall particles do not move, but their pairs are taken with the velocity of their material.
double Physics::longest_look_back(const GlobalState& global) const {
  double wall2 = 0;
  for (const Group& g : scene_->groups) {
    double v2 = 0;
    for (double v : g.wall_velocity) v2 += v * v;
    wall2 = std::max(wall2, v2);
  }
  return 0.5 * std::max(longest_advance(global), 1.0001 * std::sqrt(wall2) * global.dt);
}

// Gases and solids fly at any Mach number; of liquids it says that they are meant to be stiffer.
double Physics::speed_limit() const {
  constexpr double light = 299'792'458, mach = 10;
  if (gas_ || !scene_->has_kind(GroupKind::fluid)) return light;
  return mach * *std::max_element(groups_.sound_speed.begin(), groups_.sound_speed.end());
}

double Physics::courant_number(double dt) const {
  const double fastest = *std::max_element(groups_.sound_speed.begin(), groups_.sound_speed.end());
  return fastest * dt / scene_->smoothing_length;
}

}  // namespace sph
