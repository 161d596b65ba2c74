// Constants of a scene of fluids and solids: sums of its kernel over its lattice, what its groups are, and
// the fields that it has whatever its stages.
#include "sph/models/sph_constants.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "sph/core/kernels.hpp"
#include "sph/laws/eos/law.hpp"
#include "sph/laws/melt_viscosity.hpp"

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
  const double q = scene.start.spacing / scene.kernel.smoothing_length;
  switch (scene.kernel.shape) {
    case KernelShape::wendland_c2:
      return numbers<WendlandC2>(scene.dim, q);
    case KernelShape::wendland_c4:
      return numbers<WendlandC4>(scene.dim, q);
    case KernelShape::quintic:
      break;
  }
  return numbers<Quintic>(scene.dim, q);
}

/// Of the interface with tension; what matter becomes stays on its side.
double side_of(const Scene& scene, int group) {
  const std::array<int, 2>& between = scene.terms.surface_tension.between;
  return can_become(scene.groups, between[0], group)   ? 1
         : can_become(scene.groups, between[1], group) ? -1
                                                       : 0;
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
// Tension as a jump. Of rho c h, across the interface: with 0 that of a drop at rest moves 1.2 to 1.7 times
// as fast.
constexpr double interface_damping = 0.03;
// Of sigma / h: what keeps particles evenly spread where the pressure beside a drop is negative. With 0 the
// interface of a drop at rest moves ten times as fast, with 0.3 2.5 times.
constexpr double background = 0.75;

constexpr double stefan_boltzmann = 5.670374419e-8;  // CODATA 2018 [W/m^2/K^4]

void add_wall_heat(const GroupHeat& of, GroupTable::Heat& heat) {
  const double glow = of.radiation.emissivity * stefan_boltzmann, t = of.radiation.temperature;
  const double given = of.transfer.coefficient * of.transfer.temperature + glow * (t * t * (t * t));
  heat.wall_flux.push_back(of.wall_flux.value_or(given));
  heat.wall_transfer.push_back(of.transfer.coefficient);
  heat.wall_glow.push_back(glow);
}

// Of mu. Plates of 6 to 20 particles across bend as they should, which without it are too soft, as (h / thickness)^2: what
// one-sided sums at their faces miss of the bending is what hourglass control adds. Sums over lattices ask for 1.5 to 1.9
// at Poisson numbers of 0 to 0.4, h / dx of 0.83 to 1.2, in the plane and in space.
constexpr double bending = 1.75;

double hourglass_stiffness(const Scene& of, double modulus, double shear_modulus) {
  if (of.terms.bonds.hourglass) return *of.terms.bonds.hourglass * modulus;
  return std::min(bending * shear_modulus, modulus);
}

/// Whose bonds it shares: a body has the number of its first group.
double body_of(const Scene& of, const Group& g) {
  const Group& held = g.wall.clamps < 0 ? g : of.groups[static_cast<std::size_t>(g.wall.clamps)];
  const int whole = held.solid.body.part_of;
  return static_cast<double>(whole < 0 ? &held - of.groups.data() : whole);
}

/// Of pressure waves in a solid. A clamp has that of what it holds, a part of a rigid body that of the whole.
double modulus_of(const Scene& of, const Group& g) {
  if (g.kind == GroupKind::fluid) return 0;
  const int other = is_rigid(g) ? g.solid.body.part_of : g.wall.clamps;
  const Group& as = other < 0 ? g : of.groups[static_cast<std::size_t>(other)];
  return as.eos.bulk_modulus + 4.0 / 3.0 * as.solid.shear_modulus;
}

GroupTable group_table(const Scene& of) {
  const double divide = density_divide(of);
  GroupTable groups;
  for (const Group& g : of.groups) {
    groups.viscosity.push_back(g.viscosity_law.varies() ? viscosity_at_start(g) : g.viscosity);
    groups.sound_speed.push_back(sound_at_rest(g));
    groups.heavy.push_back(g.kind == GroupKind::fluid && g.density > divide ? 1.0 : 0.0);
    groups.side.push_back(side_of(of, static_cast<int>(&g - of.groups.data())));
    groups.mover.push_back(g.kind == GroupKind::wall ? 0.0 : 1.0);
    groups.shears.push_back(g.kind == GroupKind::fluid ? 0.0 : 1.0);
    groups.weight.density.push_back(g.density);
    const double borne = of.domain.background.density;
    const bool bubbly = g.kind != GroupKind::grain && g.eos.law->kind == EosKind::bubbly;
    groups.weight.share.push_back(bubbly || borne == 0 ? 1.0 : 1 - borne / g.density);
    groups.weight.borne.push_back(bubbly ? borne : 0.0);
    groups.bodies.number.push_back(body_of(of, g));
    groups.bodies.modulus.push_back(modulus_of(of, g));
    groups.bodies.hourglass.push_back(
        is_bonded(g) ? hourglass_stiffness(of, groups.bodies.modulus.back(), g.solid.shear_modulus) : 0.0);
    groups.bodies.bonded.push_back(is_body(g) ? 1.0 : 0.0);
    groups.heat.conductivity.push_back(g.kind == GroupKind::wall ? 0.0 : g.heat.material.conductivity);
    groups.heat.specific_heat.push_back(g.heat.material.specific_heat);
    groups.heat.wall_warmth.push_back(g.kind == GroupKind::wall && g.heat.temperature ? 1.0 : 0.0);
    add_wall_heat(g.heat, groups.heat);
    groups.heat.grip.push_back(g.wall.slip ? 0.0 : 1.0);
    groups.gas_flow.permeability.push_back(g.kind == GroupKind::wall ? 0.0
                                                                     : g.bubbly.permeability.coefficient);
    groups.gas_flow.inverse_rt.push_back(
        g.kind != GroupKind::wall && g.bubbly.gas_rt > 0 ? 1 / g.bubbly.gas_rt : 0.0);
    groups.gas_flow.diffusivity.push_back(g.bubbly.water_diffusivity);
    groups.gas_flow.wall_open.push_back(g.wall.gas_pressure ? 1.0 : 0.0);
    if (g.kind != GroupKind::grain) g.eos.law->check(g);
  }
  groups.gas_flow.surface_pressure = of.domain.surface_pressure;
  groups.surface_tension = of.terms.surface_tension.coefficient;
  return groups;
}

RowScale scale_of_rows(const Scene& of, const PositionScale& scale) {
  const double h = of.kernel.smoothing_length;
  RowScale rows{};
  rows.position_shift = row_position_shift(of, scale);
  const double unit =
      of.terms.precision == Precision::mixed ? std::ldexp(scale.quantum, rows.position_shift) : scale.quantum;
  rows.position_unit = unit / h;
  rows.inverse_volume = 1 / particle_volume(of);
  rows.inverse_h = 1 / h;
  rows.quantum = scale.quantum;
  rows.pull = of.domain.central_pull;
  for (std::size_t a = 0; a < 3; ++a) {
    rows.pull_centre[a] = of.domain.pull_centre[a];
    rows.gravity[a] = of.domain.gravity[a];
    // Along a periodic axis a body force drives a flow: no hydrostatic pressure balances it.
    rows.head[a] = of.domain.periodic[a] ? 0.0 : h;
  }
  return rows;
}

}  // namespace

SphConstants::SphConstants(const Scene& of, const PositionScale& position_scale)
    : scene(&of), scale(position_scale), wrap(wrap_of(of, position_scale)) {
  if (of.of_grains()) return;
  const KernelNumbers kernel = numbers(of);
  const double h = of.kernel.smoothing_length;
  const double volume = particle_volume(of);
  const double slope = kernel.normalisation / power(h, of.dim + 1);
  gradient_factor = volume * slope;
  force_factor = volume * volume * slope;
  kernel_at_zero = kernel.w_zero;
  own_concentration = kernel.w_zero * gradient_factor * h;
  diffusion_factor = 2 * of.terms.density_diffusion * h * (volume * slope / h);

  row_scale = scale_of_rows(of, scale);
  groups = group_table(of);
  const auto fluid = std::ranges::find_if(of.groups, is_matter);
  terms = {};
  for (std::size_t a = 0; a < 3; ++a)
    terms.gravity[a] = of.domain.periodic[a] ? 0.0 : of.domain.gravity[a] * h;
  terms.viscous.laplacian = 1 / kernel.second;
  terms.viscous.symmetric = (of.dim + 2) / kernel.fourth;
  terms.viscous.uniform = fluid->viscosity / h * terms.viscous.laplacian;
  terms.density = fluid->density * groups.weight.share[static_cast<std::size_t>(fluid - of.groups.begin())];
  terms.inverse_sound_speed = 1 / std::sqrt(fluid->eos.bulk_modulus / fluid->density);
  terms.artificial_viscosity = of.terms.artificial_viscosity;
  terms.shock.quadratic_viscosity = of.terms.gas.quadratic_viscosity;
  terms.shock.conduction = of.terms.gas.conduction;
  terms.inverse_w_spacing = 1 / kernel.w_spacing;
  const double ratio = h / of.bond_width();
  terms.bonds = {of.list_range() / h, row_scale.position_unit * ratio, ratio, power(ratio, of.dim + 1),
                 power(ratio, of.dim + 2)};
  bond_factor = gradient_factor * h * power(ratio, of.dim);
  terms.contact.range = of.start.spacing / h;
  // k over min(M_i, M_j), terms/body_contact.hpp; forces are multiplied by force_factor later.
  const double contact = contact_stiffness * particle_volume(of) / (h * h);
  terms.contact.force = contact * h / force_factor;
  terms.contact.energy = 0.25 * contact * h * h;
  if (const InterfaceTension& t = of.terms.surface_tension;
      t.coefficient > 0 && t.form == TensionForm::jump) {
    terms.jump.damping = interface_damping;
    // At a free surface nothing would hold against it.
    if (!of.start.has_surface) terms.jump.background_pressure = 2 * background * t.coefficient / h;
  }
}

double SphConstants::longest_bond() const {
  const double truncated = 2 * std::ldexp(1.0, row_scale.position_shift);
  return scene->bond_width() * (scene->kernel_radius() / scene->kernel.smoothing_length) / scale.quantum *
             (1 + 1e-6) +
         truncated;
}

PassContext SphConstants::context(Particles& particles, const NeighbourLists& lists,
                                  decomp::LargeVector<std::byte>& rows, double dt) const {
  TermConstants<double> now = terms;
  now.half_step = 0.5 * dt / scene->kernel.smoothing_length;
  RowScale scale_now = row_scale;
  scale_now.half_step = 0.5 * dt / scale.quantum;
  return {&particles,      &lists,       &groups,          scale_now, now,
          gradient_factor, force_factor, diffusion_factor, &rows};
}

PassContext SphConstants::double_context(Particles& particles, const NeighbourLists& lists,
                                         decomp::LargeVector<std::byte>& rows, double dt) const {
  PassContext c = context(particles, lists, rows, dt);
  c.scale.position_unit = scale.quantum / scene->kernel.smoothing_length;
  return c;
}

}  // namespace sph
