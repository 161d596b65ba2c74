// What a scene says of the heat of its groups: [group.heat], temperatures, fluxes.
#pragma once

#include <optional>

namespace sph {

/// Enthalpy, conduction, buoyancy. Between solidus and liquidus the latent heat is spread evenly.
struct HeatMaterial {
  double specific_heat = 0;          ///< c_p; 0: the scene has no heat [J/kg/K]
  double conductivity = 0;           ///< k [W/m/K]
  double latent_heat = 0;            ///< L [J/kg]
  double solidus = 0;                ///< [K]
  double liquidus = 0;               ///< [K]
  double expansion = 0;              ///< alpha: gravity acts on rho_0 (1 - alpha (T - T_0)) [1/K]
  double reference_temperature = 0;  ///< T_0 [K]
  friend bool operator==(const HeatMaterial&, const HeatMaterial&) = default;
};

/// q = coefficient (temperature - T) into what is beside a wall, T that of its face.
struct WallTransfer {
  double coefficient = 0;  ///< h_c; 0: none [W/m^2/K]
  double temperature = 0;  ///< of what is beyond the wall [K]
  friend bool operator==(const WallTransfer&, const WallTransfer&) = default;
};

/// q = emissivity sigma (temperature^4 - T^4).
struct WallRadiation {
  double emissivity = 0;   ///< of the face; 0: none [1]
  double temperature = 0;  ///< of what it sees [K]
  friend bool operator==(const WallRadiation&, const WallRadiation&) = default;
};

struct GroupHeat {
  HeatMaterial material;              ///< of fluids and solids
  std::optional<double> temperature;  ///< at the start, of melts too; of a wall always [K]
  std::optional<double> wall_flux;    ///< from a wall into what is beside it [W/m^2]
  WallTransfer transfer;              ///< ... or as this ...
  WallRadiation radiation;            ///< ... and this say
  friend bool operator==(const GroupHeat&, const GroupHeat&) = default;
};

}  // namespace sph
