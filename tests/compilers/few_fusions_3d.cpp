// What the scenes of this folder need of libsph/src/terms/fusions_3d_*.cpp.
#include "terms/fusion_list.hpp"

namespace sph {
namespace {

template <class T>
std::vector<Fusion> few() {
  using List = FusionList<T, 3>;
  return {
      List::template fuse<Quintic, SlippingGradient, DensityDiffusion>(),
      List::template fuse<Quintic, WallExtrapolation>(),
      List::template fuse<Quintic, WallShare>(),
      List::template fuse<Quintic, SlippingStress, Viscosity>(),
      List::template fuse<Quintic, BodyContact, BodyContactEnergy>(),
  };
}

}  // namespace

std::vector<Fusion> fusions_3d_float() { return few<float>(); }
std::vector<Fusion> fusions_3d_double() { return few<double>(); }

}  // namespace sph
