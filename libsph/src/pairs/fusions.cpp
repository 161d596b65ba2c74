#include "sph/fusions.hpp"

#include <algorithm>

namespace sph {

std::vector<Fusion> fusions_2d_float();
std::vector<Fusion> fusions_2d_double();
std::vector<Fusion> fusions_3d_float();
std::vector<Fusion> fusions_3d_double();

const std::vector<Fusion>& all_fusions() {
  static const std::vector<Fusion> all = [] {
    std::vector<Fusion> list;
    for (const auto& part :
         {fusions_2d_float(), fusions_2d_double(), fusions_3d_float(), fusions_3d_double()})
      list.insert(list.end(), part.begin(), part.end());
    return list;
  }();
  return all;
}

std::string name_of(Term term) {
  switch (term) {
    case Term::pressure:
      return "Pressure";
    case Term::weighted_pressure:
      return "WeightedPressure";
    case Term::viscosity:
      return "Viscosity";
    case Term::symmetric_viscosity:
      return "SymmetricViscosity";
    case Term::uniform_viscosity:
      return "UniformViscosity";
    case Term::viscous_operator:
      return "ViscousOperator";
    case Term::symmetric_viscous_operator:
      return "SymmetricViscousOperator";
    case Term::stress_divergence:
      return "StressDivergence";
    case Term::slipping_stress:
      return "SlippingStress";
    case Term::artificial_viscosity:
      return "ArtificialViscosity";
    case Term::number_density:
      return "NumberDensity";
    case Term::gas_moments:
      return "GasMoments";
    case Term::gas_pressure:
      return "GasPressure";
    case Term::shock_viscosity:
      return "ShockViscosity";
    case Term::shock_heating:
      return "ShockHeating";
    case Term::divergence:
      return "Divergence";
    case Term::weighted_divergence:
      return "WeightedDivergence";
    case Term::velocity_gradient:
      return "VelocityGradient";
    case Term::slipping_gradient:
      return "SlippingGradient";
    case Term::density_diffusion:
      return "DensityDiffusion";
    case Term::uniform_density_diffusion:
      return "UniformDensityDiffusion";
    case Term::pulled_density_diffusion:
      return "PulledDensityDiffusion";
    case Term::shifting:
      return "Shifting";
    case Term::colour_gradient:
      return "ColourGradient";
    case Term::surface_tension:
      return "SurfaceTension";
    case Term::curvature:
      return "Curvature";
    case Term::curvature_mean:
      return "CurvatureMean";
    case Term::tension_jump:
      return "TensionJump";
    case Term::weighted_tension_jump:
      return "WeightedTensionJump";
    case Term::wall_extrapolation:
      return "WallExtrapolation";
    case Term::wall_extrapolation_by_density:
      return "WallExtrapolationByDensity";
    case Term::wall_share:
      return "WallShare";
    case Term::ida_gradient:
      return "IdaGradient";
    case Term::ida_stress:
      return "IdaStress";
    case Term::deformation:
      return "Deformation";
    case Term::bond_force:
      return "BondForce";
    case Term::bond_viscosity:
      return "BondViscosity";
    case Term::body_contact:
      return "BodyContact";
    case Term::body_contact_energy:
      return "BodyContactEnergy";
  }
  return "?";
}

const Fusion& find_fusion(int dim, Precision precision, KernelShape kernel, const std::vector<Term>& terms) {
  const auto sorted = [](std::vector<Term> t) {
    std::sort(t.begin(), t.end());
    return t;
  };
  for (const Fusion& f : all_fusions())
    if (f.dim == dim && f.precision == precision && f.kernel == kernel && sorted(f.terms) == sorted(terms))
      return f;
  std::string line = kernel == KernelShape::quintic       ? "fuse<Quintic"
                     : kernel == KernelShape::wendland_c2 ? "fuse<WendlandC2"
                                                          : "fuse<WendlandC4";
  for (Term t : terms) line += ", " + name_of(t);
  throw InputError("this combination of terms is not compiled; add the line \"" + line +
                   ">(),\" to libsph/src/pairs/fusion_list.hpp and rebuild");
}

std::byte* aligned_scratch(decomp::LargeVector<std::byte>& scratch, std::size_t bytes) {
  constexpr std::size_t alignment = 64;
  if (scratch.size() < bytes + alignment) scratch.resize(bytes + bytes / 8 + alignment);
  const auto address = reinterpret_cast<std::uintptr_t>(scratch.data());
  return scratch.data() + (alignment - address % alignment) % alignment;
}

}  // namespace sph
