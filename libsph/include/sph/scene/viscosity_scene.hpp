// What a scene says of a fluid whose viscosity follows its temperature, dissolved water, crystals and bubbles:
// [group.viscosity_law].
#pragma once

#include <optional>

namespace sph {

/// Of the crystal-free liquid: that of group.viscosity; eta_0 exp(-b (T - T_0)); log10 eta = A + B / (T - C) (Vogel,
/// Fulcher, Tammann; Giordano et al. 2008 give A, B, C of a melt); of hydrous rhyolite (Hess & Dingwell 1996).
enum class ViscosityLaw { constant, exponential, vogel, hess_dingwell };
/// (1 - phi / phi_m)^-2.5, phi the frozen share (Einstein, Roscoe 1952).
enum class CrystalLaw { none, einstein_roscoe };
/// Of psi, the gas's share of the volume: 1 / (1 - psi) while bubbles stay round, (1 - psi)^(5/3) once they are stretched
/// (Llewellin & Manga 2005).
enum class BubbleLaw { none, round, stretched };

struct VogelConstants {
  double a = 0, b = 0, c = 0;  ///< A [1], B [K], C [K]
  friend bool operator==(const VogelConstants&, const VogelConstants&) = default;
};

struct ViscosityModel {
  double bulk = 0;  ///< zeta, Ida eq. (9): of all fluids and solids [Pa s]
  ViscosityLaw law = ViscosityLaw::constant;
  double fall = 0;                   ///< b [1/K]
  double reference_temperature = 0;  ///< T_0 [K]
  VogelConstants vogel;
  std::optional<double> temperature;  ///< of a scene without heat [K]
  CrystalLaw crystals = CrystalLaw::none;
  double maximum_packing = 0.6;  ///< phi_m
  BubbleLaw bubbles = BubbleLaw::none;
  double least = 0;            ///< [Pa s]
  std::optional<double> most;  ///< [Pa s]

  /// Particles of the group differ.
  [[nodiscard]] bool varies() const {
    return law != ViscosityLaw::constant || crystals != CrystalLaw::none || bubbles != BubbleLaw::none;
  }
  friend bool operator==(const ViscosityModel&, const ViscosityModel&) = default;
};

}  // namespace sph
