// A material of a scene, and what is one only for some kinds of matter.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "sph/scene/fluid_scene.hpp"
#include "sph/scene/gas_scene.hpp"
#include "sph/scene/grain_scene.hpp"
#include "sph/scene/heat_scene.hpp"
#include "sph/scene/melt_scene.hpp"
#include "sph/scene/solid_scene.hpp"
#include "sph/scene/transition_scene.hpp"
#include "sph/scene/viscosity_scene.hpp"

namespace sph {

enum class GroupKind { fluid, solid, wall, grain, melt };
/// What the pressure depends on besides the density: nothing, the gas content, the internal energy.
enum class EosKind { barotropic, bubbly, ideal_gas };
struct EquationOfState;  // laws/eos/law.hpp
[[nodiscard]] const EquationOfState* linear_eos();

/// How the pressure follows from the density.
struct Compressibility {
  const EquationOfState* law = linear_eos();
  double bulk_modulus = 0;   ///< K, or K_l of the liquid [Pa]
  LawConstants constants{};  ///< of the law, in the order of its keys
  GasMaterial gas;           ///< of an ideal one
  friend bool operator==(const Compressibility&, const Compressibility&) = default;
};

/// Of matter that stays where it is: walls, and as to the velocity fixed grains.
struct WallMaterial {
  Double3 velocity{};  ///< of the material, with which it drags what touches it [m/s]
  bool slip = false;   ///< no shear on what flows past
  std::optional<double>
      gas_pressure;  ///< beyond it, of gas that it lets pass, above that of the surface [Pa]
  int clamps = -1;   ///< index of the total-Lagrangian solid that is bonded to it, -1 if none
  friend bool operator==(const WallMaterial&, const WallMaterial&) = default;
};

/// One material. Particles name it by its index in Scene::groups.
struct Group {
  std::string name;
  GroupKind kind = GroupKind::fluid;
  double density = 0;    ///< rho_0 at zero pressure [kg/m^3]
  Compressibility eos;   ///< all but grains
  double viscosity = 0;  ///< eta [Pa s]
  ViscosityModel viscosity_law;
  std::vector<Transition> becomes;  ///< in their order: the first that holds
  BubblyMaterial bubbly;
  SolidMaterial solid;
  WallMaterial wall;
  GroupHeat heat;
  GrainMaterial
      grain;  ///< besides it grains have name, density and wall.velocity; melts name, density, viscosity
  friend bool operator==(const Group&, const Group&) = default;
};

/// Loses bonds as it becomes something else.
[[nodiscard]] inline bool can_fail(const Group& g) {
  return std::ranges::any_of(g.becomes, &Transition::of_failure);
}

/// `to` is the group `from`, an index or -1, or what that turns into by and by.
[[nodiscard]] bool can_become(const std::vector<Group>& groups, int from, int to);

/// A total-Lagrangian solid: to a fluid a wall that moves.
[[nodiscard]] inline bool is_body(const Group& g) {
  return g.kind == GroupKind::solid && g.solid.lagrangian == Lagrangian::total;
}
/// ... that deforms, or does not.
[[nodiscard]] inline bool is_bonded(const Group& g) { return is_body(g) && !g.solid.body.rigid; }
[[nodiscard]] inline bool is_rigid(const Group& g) { return is_body(g) && g.solid.body.rigid; }

/// Some updated-Lagrangian solid yields.
[[nodiscard]] bool has_strength(const std::vector<Group>& groups);

/// Moves as a fluid or a solid, not as grains.
[[nodiscard]] inline bool is_matter(const Group& g) {
  return g.kind == GroupKind::fluid || g.kind == GroupKind::solid;
}

}  // namespace sph
