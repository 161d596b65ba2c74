// What the library asks of an equation of state, all of it in the law's one header. Pressures are absolute;
// the momentum equation uses them less the surface pressure. A barotropic law, p = p(rho), is a struct:
//
//   struct MyEos : BarotropicLaw {
//     static constexpr std::string_view word = "my_eos";                    // of eos
//     static constexpr std::array keys{LawKey{"my_constant", dimension::none}};  // in Group::eos.constants
//     static double pressure(const Group&, double density);      // 0 at rho_0
//     static double density(const Group&, double pressure);      // its inverse
//     static double sound_speed(const Group&, double density);   // sqrt(dp/drho); at rho_0 sqrt(K/rho_0)
//     static double energy(const Group&, double density);        // integral of p/rho^2 from rho_0, in K/rho_0
//   };
//
// and pressures, sound speeds, time steps, starts and energies follow (laws/eos/registry.hpp). Bubbly magma and
// ideal gases carry more than a density: they answer for whole rows (laws/eos/bubbly.hpp, laws/eos/ideal_gas.hpp), and
// models of their own go with them. Functions feed the state: no libm but sqrt (exact_math.hpp).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string_view>

#include "sph/scene/law_key.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

/// Particles whose pressure is wanted; a null pointer is what the scene does not have, or nobody wants.
struct EosRows {
  const double *density, *gas_content, *specific_energy, *dissolved_gas;
  double *pressure, *sound_speed, *void_fraction;
  double surface_pressure;
};

/// What a particle starts with.
struct EosStart {
  double density;
  double specific_energy = 0;  ///< of a gas
};

/// The bottom of a still layer, `depth` below a place where the pressure is `pressure` above that of the
/// surface.
struct StillLayer {
  double pressure, surface_pressure, gravity, depth;
};

struct EosLaw {
  static constexpr std::array<LawKey, 0> keys{};
  static constexpr bool needs_pressure = false;  ///< at zero pressure it is all gas
  /// What helps where a start finds no density > 0.
  static constexpr std::string_view remedy =
      "raise the group's bulk_modulus or sound_speed, or the least pressure of the start";
  static void check(const Group&) {}  ///< throws InputError where the constants make no law
};

/// p = p(rho), no other state.
struct BarotropicLaw : EosLaw {
  static constexpr EosKind kind = EosKind::barotropic;
  static constexpr bool constant_sound = false;  ///< sound_speed() is that of rho_0 at any density
};

/// Of a group's matter at rho_0; p-waves are the fastest in a solid [m/s].
[[nodiscard]] inline double sound_at_rest(const Group& g) {
  const double modulus =
      g.eos.bulk_modulus + (g.kind == GroupKind::solid ? 4.0 / 3.0 * g.solid.shear_modulus : 0.0);
  return std::sqrt(modulus / g.density);
}

/// A law as code knows it that is not compiled for it (laws/eos/registry.hpp makes it of the struct).
struct EquationOfState {
  std::string_view word;
  std::span<const LawKey> keys;
  EosKind kind;
  bool constant_sound, needs_pressure;
  std::string_view remedy;
  void (*check)(const Group&);
  /// Pressure, sound speed and void fraction of rows [first, last), all of this group.
  void (*derive)(const Group&, const EosRows&, std::size_t first, std::size_t last);
  EosStart (*start)(const Group&, double above_surface, double surface_pressure);
  double (*density)(const Group&, double pressure);
  double (*energy)(const Group&, double density);             ///< of compression, per mass [K/rho_0]
  double (*pressure_below)(const Group&, const StillLayer&);  ///< nullptr: it is integrated
};

/// Has some group of the scene such a law?
[[nodiscard]] bool has_eos(const Scene& scene, EosKind kind);

/// All laws; from the first look on none can be added.
[[nodiscard]] std::span<const EquationOfState* const> equations_of_state();
/// Throws std::logic_error where the word is taken, a key has another meaning already, or laws have been looked at.
void register_equation_of_state(const EquationOfState& law);

}  // namespace sph
