// The explicit list of compiled fusions, the same for each dimension and precision. A new one is a new line.
#pragma once

#include "sph/pairs/fuse.hpp"
#include "sph/terms/artificial_viscosity.hpp"
#include "sph/terms/body_contact.hpp"
#include "sph/terms/bonds.hpp"
#include "sph/terms/clamp.hpp"
#include "sph/terms/crack.hpp"
#include "sph/terms/density_diffusion.hpp"
#include "sph/terms/divergence.hpp"
#include "sph/terms/gas.hpp"
#include "sph/terms/ida.hpp"
#include "sph/terms/interface_curvature.hpp"
#include "sph/terms/pressure.hpp"
#include "sph/terms/shifting.hpp"
#include "sph/terms/shock.hpp"
#include "sph/terms/stress.hpp"
#include "sph/terms/surface_tension.hpp"
#include "sph/terms/tension_jump.hpp"
#include "sph/terms/viscosity.hpp"
#include "sph/terms/viscous_operator.hpp"
#include "sph/terms/wall.hpp"
#include "sph/terms/wetted.hpp"

namespace sph {

template <class T, int D>
struct FusionList {
  template <class Kernel, class... Terms>
  static Fusion fuse() {
    return fusion_of<T, D, Kernel, Terms...>();
  }

  template <class Kernel>
  static std::vector<Fusion> fluids() {
    return {
        fuse<Kernel, Divergence, UniformDensityDiffusion>(),
        fuse<Kernel, Divergence, UniformDensityDiffusion, Concentration>(),
        fuse<Kernel, Divergence, DensityDiffusion>(),
        fuse<Kernel, Divergence, DensityDiffusion, Concentration>(),
        fuse<Kernel, Pressure>(),
        fuse<Kernel, Pressure, UniformViscosity>(),
        fuse<Kernel, Pressure, Viscosity>(),
        fuse<Kernel, Pressure, SymmetricViscosity>(),
        fuse<Kernel, Pressure, UniformViscosity, ArtificialViscosity>(),
        fuse<Kernel, Pressure, ArtificialViscosity>(),
        fuse<Kernel, WallExtrapolation>(),
        fuse<Kernel, WallShare>(),
        fuse<Kernel, WallViscosity>(),
        fuse<Kernel, Concentration>(),
        fuse<Kernel, ViscousOperator>(),
    };
  }

  /// Grains are spheres.
  template <class Kernel>
  static std::vector<Fusion> mixtures() {
    if constexpr (D == 3)
      return {
          fuse<Kernel, Divergence, MixtureDensityDiffusion>(),
          fuse<Kernel, Divergence, MixtureDensityDiffusion, Concentration>(),
          fuse<Kernel, MixtureWallExtrapolation>(),
      };
    return {};
  }

  static std::vector<Fusion> all() {
    std::vector<Fusion> list = fluids<Quintic>();
    for (auto& more : {fluids<WendlandC2>(), fluids<WendlandC4>(), mixtures<Quintic>(),
                       mixtures<WendlandC2>(), mixtures<WendlandC4>(), mixtures_of_several()})
      list.insert(list.end(), more.begin(), more.end());
    for (Fusion f : {
             fuse<Quintic, Divergence, DensityDiffusion, ColourGradient>(),
             fuse<Quintic, Divergence, DensityDiffusion, Concentration, ColourGradient>(),
             fuse<Quintic, WeightedDivergence, DensityDiffusion>(),
             fuse<Quintic, WeightedDivergence, DensityDiffusion, Concentration>(),
             fuse<Quintic, WeightedDivergence, DensityDiffusion, ColourGradient>(),
             fuse<Quintic, WeightedDivergence, DensityDiffusion, Concentration, ColourGradient>(),
             fuse<Quintic, WallExtrapolation, WallExtrapolationByDensity>(),
             fuse<Quintic, Divergence, PulledDensityDiffusion>(),
             fuse<Quintic, Divergence, PulledDensityDiffusion, Concentration>(),
             fuse<Quintic, WeightedPressure>(),
             fuse<Quintic, WeightedPressure, ArtificialViscosity>(),
             fuse<Quintic, Pressure, SurfaceTension>(),
             fuse<Quintic, WeightedPressure, SurfaceTension>(),
             fuse<Quintic, Curvature>(),
             fuse<Quintic, CurvatureMean>(),
             fuse<Quintic, Pressure, TensionJump>(),
             fuse<Quintic, WeightedPressure, WeightedTensionJump>(),
             fuse<Quintic, SymmetricViscousOperator>(),
             fuse<Quintic, NumberDensity, GasMoments>(),
             fuse<Quintic, GasPressure, Viscosity, ShockViscosity, ShockHeating>(),
             fuse<Quintic, VelocityGradient, DensityDiffusion>(),
             fuse<Quintic, SlippingGradient, DensityDiffusion>(),
             fuse<Quintic, VelocityGradient, DensityDiffusion, Concentration>(),
             fuse<Quintic, SlippingGradient, DensityDiffusion, Concentration>(),
             fuse<Quintic, IdaGradient>(),
             fuse<Quintic, IdaStress>(),
             fuse<Quintic, IdaStress, ArtificialViscosity>(),
             fuse<Quintic, Deformation>(),
             fuse<Quintic, Deformation, BodyContactEnergy>(),
             fuse<Quintic, CrackedDeformation, CrackedBodyContactEnergy, CrackSums>(),
             fuse<Quintic, WettedExtrapolation>(),
             fuse<Quintic, FlowOntoSolids>(),
             fuse<Quintic, CrackedFlowOntoSolids>(),
             fuse<Quintic, ClampSums>(),
             fuse<Quintic, ClampReaction>(),
             fuse<Quintic, BodyContact, BodyContactEnergy>(),
             fuse<Quintic, BondForce>(),
             fuse<Quintic, BondForce, BondViscosity>(),
             fuse<Quintic, BondForce, BodyContact>(),
             fuse<Quintic, BondForce, BodyContact, BondViscosity>(),
             fuse<Quintic, CrackedBondForce>(),
             fuse<Quintic, CrackedBondForce, CrackedBodyContact>(),
             fuse<Quintic, CrackedBondForce, CrackedBodyContact, CrackedBondViscosity>(),
         })
      list.push_back(std::move(f));
    for (auto& more : {forces<Viscosity>(), forces<SymmetricViscosity>(), wetted<WettedViscosity>(),
                       wetted<WettedSymmetricViscosity>(), wetted_kinematics<DensityDiffusion>(),
                       wetted_kinematics<PulledDensityDiffusion>()})
      list.insert(list.end(), more.begin(), more.end());
    return list;
  }

  static std::vector<Fusion> mixtures_of_several() {
    if constexpr (D == 3)
      return {
          fuse<Quintic, MixtureWallExtrapolation, MixtureWallExtrapolationByDensity>(),
          fuse<Quintic, WeightedDivergence, MixtureDensityDiffusion>(),
          fuse<Quintic, WeightedDivergence, MixtureDensityDiffusion, Concentration>(),
          fuse<Quintic, Divergence, MixtureDensityDiffusion, ColourGradient>(),
          fuse<Quintic, Divergence, MixtureDensityDiffusion, Concentration, ColourGradient>(),
          fuse<Quintic, WeightedDivergence, MixtureDensityDiffusion, ColourGradient>(),
          fuse<Quintic, WeightedDivergence, MixtureDensityDiffusion, Concentration, ColourGradient>(),
      };
    return {};
  }

  template <class Diffusion>
  static std::vector<Fusion> wetted_kinematics() {
    return {
        fuse<Quintic, Divergence, Diffusion, FlowFromSolids>(),
        fuse<Quintic, Divergence, Diffusion, FlowFromSolids, Concentration>(),
    };
  }

  /// Total-Lagrangian solids in a fluid.
  template <class Viscous>
  static std::vector<Fusion> wetted() {
    return {
        fuse<Quintic, WettedPressure, Viscous>(),
        fuse<Quintic, WettedPressure, Viscous, WettedArtificialViscosity>(),
        fuse<Quintic, CrackedWettedPressure, BorneByFluid, Viscous>(),
        fuse<Quintic, CrackedWettedPressure, BorneByFluid, Viscous, WettedArtificialViscosity>(),
    };
  }

  /// Fluids of different viscosity or density, and solids.
  template <class Viscous>
  static std::vector<Fusion> forces() {
    return {
        fuse<Quintic, Pressure, Viscous, ArtificialViscosity>(),
        fuse<Quintic, Pressure, Viscous, SurfaceTension>(),
        fuse<Quintic, Pressure, Viscous, TensionJump>(),
        fuse<Quintic, WeightedPressure, Viscous>(),
        fuse<Quintic, WeightedPressure, Viscous, ArtificialViscosity>(),
        fuse<Quintic, WeightedPressure, Viscous, SurfaceTension>(),
        fuse<Quintic, WeightedPressure, Viscous, WeightedTensionJump>(),
        fuse<Quintic, StressDivergence, Viscous>(),
        fuse<Quintic, StressDivergence, Viscous, ArtificialViscosity>(),
        fuse<Quintic, SlippingStress, Viscous>(),
        fuse<Quintic, SlippingStress, Viscous, ArtificialViscosity>(),
    };
  }
};

}  // namespace sph
