// What a scene of solids says beyond what every scene says.
#pragma once

#include <array>
#include <optional>

#include "sph/scene/grain_scene.hpp"
#include "sph/scene/prescribed_motion.hpp"

namespace sph {

/// updated: stress follows the rate of strain; total: it is a function of the deformation since the start.
enum class Lagrangian { updated, total };

enum class StrengthLaw { mohr_coulomb, drucker_prager };

/// How much an updated-Lagrangian solid bears (laws/mohr_coulomb.hpp, laws/drucker_prager.hpp).
struct Strength {
  StrengthLaw law = StrengthLaw::mohr_coulomb;
  double cohesion = 0;                     ///< c [Pa]
  double friction_angle = 0;               ///< phi [degrees]
  double dilatancy_angle = 0;              ///< psi, at most phi [degrees]
  std::optional<double> tensile_strength;  ///< [Pa]; without, the tip of the cone
  std::optional<double> fracture_energy;   ///< G_f, that cohesion takes until it is residual [J/m^2]
  double residual_cohesion = 0;            ///< [Pa]
  friend bool operator==(const Strength&, const Strength&) = default;
};

/// A total-Lagrangian solid that does not deform (models/rigid_bodies.hpp).
struct RigidMaterial {
  bool rigid = false;
  int part_of = -1;                        ///< group whose body its particles belong to, -1: one of its own
  std::array<bool, 4> held{};              ///< x, y, z, rotation: no force changes that motion
  std::optional<Double3> velocity;         ///< of the start; without, that of its particles [m/s]
  std::optional<Double3> spin;             ///< ... in 2D about z [rad/s]
  std::optional<PrescribedMotion> motion;  ///< that it has whatever acts on it
  static constexpr std::size_t rotation = 3;  ///< in held
  [[nodiscard]] bool holds(std::size_t kind_of_motion) const { return motion || held[kind_of_motion]; }
  friend bool operator==(const RigidMaterial&, const RigidMaterial&) = default;
};

/// Of a group with kind = "solid".
struct SolidMaterial {
  double shear_modulus = 0;  ///< mu [Pa]; lambda = K - 2/3 mu
  Lagrangian lagrangian = Lagrangian::updated;
  std::optional<Strength> strength;
  RigidMaterial body;
  friend bool operator==(const SolidMaterial&, const SolidMaterial&) = default;
};

/// Of how far lists reach: bonds of what can fail are lost there, seen before lists lose them.
inline constexpr double nearly_lost = 0.95;

/// Between the particles of a total-Lagrangian solid.
struct BondTerms {
  std::optional<double> hourglass;  ///< stiffness against hourglass modes / modulus; without, that of plates
  double largest_stretch = 1.2;     ///< of a bond, as far as the lists reach
  std::optional<double> reach;  ///< of a bond in the reference state / spacing; without, the kernel's radius
  friend bool operator==(const BondTerms&, const BondTerms&) = default;
};

}  // namespace sph
