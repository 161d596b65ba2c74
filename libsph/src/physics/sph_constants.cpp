// Constants of a scene of fluids and solids: sums of its kernel over its lattice, what its groups are, and
// the fields that it has whatever its stages.
#include <algorithm>
#include <cmath>
#include <type_traits>

#include "sph/kernels.hpp"
#include "sph/physics.hpp"

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

}  // namespace sph
