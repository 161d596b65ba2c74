// What a scene says of its fluids: the volatiles of a bubbly one, the forms of viscous and pressure forces, the
// tension of interfaces.
#pragma once

#include <array>
#include <optional>

namespace sph {

/// How the permeability k of bubbly magma depends on the gas's share of the volume psi: coefficient times psi^n
/// (Klug & Cashman 1996), (psi - threshold)^n above it (Rust & Cashman 2004), psi^3 / (1 - psi)^2 (Kozeny, Carman).
enum class PermeabilityLaw { power, percolation, kozeny_carman };

struct Permeability {
  PermeabilityLaw law = PermeabilityLaw::power;
  double coefficient = 0;       ///< 0: tight [m^2]
  double exponent = 3.4;        ///< n
  double threshold = 0.3;       ///< of psi
  double gas_viscosity = 2e-5;  ///< [Pa s]
  /// Of psi, at which bubbles that were connected are no more; none: at `threshold`.
  std::optional<double> closing_threshold;
  /// Forchheimer's second permeability is coefficient k^exponent [m]; 0: gas flows too slowly for it.
  double inertial_coefficient = 0, inertial_exponent = 1.353;
  friend bool operator==(const Permeability&, const Permeability&) = default;
};

/// Of a group with eos = "bubbly": Ida eqs. (12) to (15).
struct BubblyMaterial {
  double gas_content = 0;          ///< m, Ida eq. (14) [1]
  double gas_rt = 0;               ///< R T, Ida eq. (13) [m^2/s^2]
  double solubility_pressure = 0;  ///< p_s [Pa]
  double solubility_exponent = 1;  ///< gamma [1]
  double exsolution_time = 0;      ///< tau, in which what is dissolved follows the pressure; 0: at once [s]
  double water_diffusivity = 0;    ///< D of what is dissolved; 0: it stays [m^2/s]
  Permeability permeability;       ///< of its gas
  friend bool operator==(const BubblyMaterial&, const BubblyMaterial&) = default;
};

/// How the pressures of a pair are summed: p_i + p_j, or each weighted by the other's density.
enum class PressureWeights { volume, density };
/// See sph/terms/viscosity.hpp.
enum class ViscosityForm { laplacian, symmetric };

struct ViscousForces {
  ViscosityForm form = ViscosityForm::laplacian;
  bool implicit = false;    ///< those of the end of the step: they limit no time step
  double tolerance = 1e-4;  ///< of implicit viscosity, see models/viscosity.cpp
  friend bool operator==(const ViscousForces&, const ViscousForces&) = default;
};

/// A stress in a layer as thick as the kernel, or the jump of the pressure (terms/surface_tension.hpp,
/// terms/tension_jump.hpp).
enum class TensionForm { stress, jump };

/// Between the particles of two groups of fluid.
struct InterfaceTension {
  std::array<int, 2> between{-1, -1};  ///< groups; -1: there is none
  double coefficient = 0;              ///< sigma [N/m]
  TensionForm form = TensionForm::stress;
  friend bool operator==(const InterfaceTension&, const InterfaceTension&) = default;
};

}  // namespace sph
