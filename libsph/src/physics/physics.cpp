#include "sph/physics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pairs/poison_rows.hpp"
#include "sph/grains.hpp"

namespace sph {

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
  add_drift();
  add_kick();
}

Stage Physics::sums_over_pairs(std::string name, const std::vector<Term>& terms, Rows rows) {
  const Fusion& fusion = find_fusion(scene_->dim, scene_->precision, scene_->kernel, terms);
  fields_ |= fusion.writes;
  const auto work = [this, &fusion, rows](StepState& s, Side side) {
    const PassContext context = this->context(s.particles, s.lists, s.rows, s.global.dt);
    const std::size_t owned = s.particles.owned();
    // Interior particles have no partner in the halo, so rows of the halo are packed only afterwards.
    const bool interior = side == Side::interior;
    const auto pack = s.iteration == 0 ? fusion.pack : fusion.repack;
    pack(context, interior ? 0 : owned, interior ? owned : s.particles.rows());
    if (interior && s.iteration == 0) poison_rows(context, fusion.row_bytes, owned, s.particles.rows());
    if (rows != Rows::walls)
      fusion.run(context,
                 range_of(s.ranges, interior ? RowClass::interior_movers : RowClass::boundary_movers));
    if (rows != Rows::movers)
      fusion.run(context, range_of(s.ranges, interior ? RowClass::interior_walls : RowClass::boundary_walls));
  };
  return {std::move(name), decomp::Region::pairs, fields_behind(fusion.values), fusion.writes, work, {},
          &fusion};
}

void Physics::add_sums(std::string name, const std::vector<Term>& terms, Rows rows) {
  append(plan_.sums, sums_over_pairs(std::move(name), terms, rows));
}

void Physics::add_update(std::string name, FieldSet writes, Update update) {
  append(plan_.sums, {std::move(name),
                      decomp::Region::update,
                      {},
                      writes,
                      [update](StepState& s, Side) { update(s.particles, s.ranges, s.global); },
                      {}});
}

void Physics::add_drift() {
  append(plan_.drift, {"drift",
                       decomp::Region::update,
                       {},
                       FieldSet{Field::position, Field::displacement},
                       [this](StepState& s, Side) { advance(s.particles, s.ranges, s.global.dt); },
                       [this](const GlobalState& global) { return longest_advance(global); }});
}

void Physics::add_kick() {
  FieldSet changed{Field::velocity};
  if (scene_->terms.shifting) changed |= FieldSet{Field::position};
  if (bulk_viscous_) changed |= FieldSet{Field::pressure};
  if (gas_) changed |= FieldSet{Field::specific_energy, Field::pressure, Field::sound_speed};
  if (!transitions_.empty()) changed |= FieldSet{Field::group};
  append(plan_.kick, {"kick",
                      decomp::Region::update,
                      {},
                      changed,
                      [this](StepState& s, Side) { s.maxima = integrate(s.particles, s.ranges, s.global); },
                      [this](const GlobalState& global) { return longest_shift(global); }});
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
  add_sums("kinematics", kinematics);
  add_update("densities", {Field::density, Field::stress, Field::pressure, Field::sound_speed},
             [this](Particles& p, const RowRanges& ranges, const GlobalState& global) {
               for (RowClass c : {RowClass::interior_movers, RowClass::boundary_movers}) {
                 const RowRange& r = range_of(ranges, c);
                 update_movers(p, r.first, r.last, global);
               }
             });

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
  add_sums("forces", forces);
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
  add_sums("walls", terms, Rows::walls);
  add_update("wall pressures", {Field::pressure, Field::velocity, Field::wall_pressures, Field::wall_mirror},
             [this](Particles& p, const RowRanges& ranges, const GlobalState& global) {
               update_walls(p, ranges, global);
             });
  plan_.output.assign(plan_.sums.end() - 2, plan_.sums.end());
}

// Only where fluid flies can it come into walls.
void Physics::find_walls_nearby() {
  wall_distance_.emplace(scene_->kernel, scene_->dim, scene_->spacing / scene_->smoothing_length);
  add_sums("wall distance", {Term::wall_share});
  if (!scene_->free_surface) return;
  add_update("walls hold", {Field::force},
             [this](Particles& p, const RowRanges& ranges, const GlobalState& global) {
               hold_off(p, ranges, global.dt);
             });
}

// The paper's cycle: velocity gradient (10), density (8), pressure, stress (9) or (11) of every particle,
// walls included; then the force (6) on those that move.
void Physics::build_ida() {
  add_sums("gradient", {Term::ida_gradient}, Rows::all);
  add_update("densities and stresses", {Field::density, Field::stress, Field::pressure, Field::sound_speed},
             [this](Particles& p, const RowRanges& ranges, const GlobalState& global) {
               for (const RowRange& r : ranges) update_ida(p, r.first, r.last, global.dt);
             });
  std::vector<Term> forces{Term::ida_stress};
  if (scene_->terms.artificial_viscosity > 0) forces.push_back(Term::artificial_viscosity);
  add_sums("forces", forces);
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
