// Passes that exchange what a scene's budgets count: in double precision whatever that of the scene.
#include "sph/pairs/fuse.hpp"
#include "sph/terms/conduction.hpp"
#include "sph/terms/gas_flow.hpp"
#include "sph/terms/viscous_heat.hpp"
#include "sph/terms/water_diffusion.hpp"

namespace sph {
namespace {

template <class Kernel, int D>
std::vector<Fusion> exchanges() {
  return {fusion_of<double, D, Kernel, Conduction>(),
          fusion_of<double, D, Kernel, ConductionOperator>(),
          fusion_of<double, D, Kernel, WallConduction>(),
          fusion_of<double, D, Kernel, WallTransferConduction>(),
          fusion_of<double, D, Kernel, GasFlow>(),
          fusion_of<double, D, Kernel, GasFlow, GasHeat>(),
          fusion_of<double, D, Kernel, GasSlope>(),
          fusion_of<double, D, Kernel, GasOperator>(),
          fusion_of<double, D, Kernel, ImplicitGasFlow>(),
          fusion_of<double, D, Kernel, ImplicitGasFlow, ImplicitGasHeat>(),
          fusion_of<double, D, Kernel, WallGas>(),
          fusion_of<double, D, Kernel, WaterDiffusion>(),
          fusion_of<double, D, Kernel, WaterDiffusion, WaterHeat>(),
          fusion_of<double, D, Kernel, ViscousHeat>(),
          fusion_of<double, D, Kernel, SymmetricViscousHeat>()};
}

}  // namespace

std::vector<Fusion> exchange_fusions() {
  std::vector<Fusion> all;
  for (auto& part : {exchanges<Quintic, 2>(), exchanges<WendlandC2, 2>(), exchanges<WendlandC4, 2>(),
                     exchanges<Quintic, 3>(), exchanges<WendlandC2, 3>(), exchanges<WendlandC4, 3>()})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace sph
