// What the scenes of this folder need of libsph/src/terms/fusions_2d_*.cpp: compiled in a fraction of the time.
#include "terms/fusion_list.hpp"

namespace sph {
namespace {

template <class T>
std::vector<Fusion> few() {
  using List = FusionList<T, 2>;
  return {
      List::template fuse<Quintic, Divergence, DensityDiffusion>(),
      List::template fuse<Quintic, WeightedDivergence, DensityDiffusion, Concentration, ColourGradient>(),
      List::template fuse<Quintic, SlippingGradient, DensityDiffusion>(),
      List::template fuse<Quintic, WallExtrapolation>(),
      List::template fuse<Quintic, WallExtrapolation, WallExtrapolationByDensity>(),
      List::template fuse<Quintic, WeightedPressure, SymmetricViscosity, SurfaceTension>(),
      List::template fuse<Quintic, Pressure, SymmetricViscosity>(),
      List::template fuse<Quintic, WeightedPressure, SurfaceTension>(),
      List::template fuse<Quintic, WallShare>(),
      List::template fuse<Quintic, SymmetricViscousOperator>(),
      List::template fuse<Quintic, SlippingStress, Viscosity, ArtificialViscosity>(),
      List::template fuse<Quintic, Deformation, BodyContactEnergy>(),
      List::template fuse<Quintic, BondForce>(),
      List::template fuse<Quintic, BondForce, BodyContact, BondViscosity>(),
      List::template fuse<Quintic, CrackedDeformation, CrackedBodyContactEnergy, CrackSums>(),
      List::template fuse<Quintic, CrackedBondForce>(),
      List::template fuse<Quintic, CrackedBondForce, CrackedBodyContact, CrackedBondViscosity>(),
      List::template fuse<Quintic, CrackedWettedPressure, BorneByFluid, WettedViscosity>(),
      List::template fuse<Quintic, ClampSums>(),
      List::template fuse<Quintic, ClampReaction>(),
      List::template fuse<Quintic, WettedExtrapolation>(),
      List::template fuse<Quintic, FlowOntoSolids>(),
      List::template fuse<Quintic, CrackedFlowOntoSolids>(),
      List::template fuse<Quintic, Divergence, DensityDiffusion, FlowFromSolids>(),
      List::template fuse<Quintic, WettedPressure, WettedViscosity>(),
      List::template fuse<Quintic, NumberDensity, GasMoments>(),
      List::template fuse<Quintic, GasPressure, Viscosity, ShockViscosity, ShockHeating>(),
      List::template fuse<Quintic, IdaGradient>(),
      List::template fuse<Quintic, IdaStress>(),
      List::template fuse<WendlandC4, Divergence, UniformDensityDiffusion, Concentration>(),
      List::template fuse<WendlandC4, Pressure, UniformViscosity>(),
  };
}

}  // namespace

std::vector<Fusion> fusions_2d_float() { return few<float>(); }
std::vector<Fusion> fusions_2d_double() { return few<double>(); }

}  // namespace sph
