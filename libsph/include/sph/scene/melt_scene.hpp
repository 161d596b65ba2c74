// What a scene says of melts, which flow slowly on a grid: [melt] and its sides.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace sph {

/// A side of the domain, as an index: 2 axis + (0 lower, 1 upper).
enum class MeltFace { x0, x1, y0, y1, z0, z1 };
/// What temperatures start with: those of the groups, or what conducts between two sides.
enum class MeltProfile { groups, conductive };
/// What shares of the second melt start with: those of the regions' groups, or evenly from none below to all above.
enum class MeltMixture { groups, linear };

/// Without an entry a side without period is slippery and lets no heat pass.
struct MeltSide {
  MeltFace side = MeltFace::x0;
  bool slip = true;
  std::optional<double> temperature;  ///< [K]
  std::optional<double> heat_flux;    ///< inward, over the heat capacity per volume [K m/s]
  friend bool operator==(const MeltSide&, const MeltSide&) = default;
};

struct MeltStart {
  MeltProfile profile = MeltProfile::groups;
  MeltMixture mixture = MeltMixture::groups;
  double wave_height = 0;  ///< by which all is displaced along the last axis [m]
  double wave_length = 0;  ///< in all other directions [m]
  friend bool operator==(const MeltStart&, const MeltStart&) = default;
};

struct MeltControl {
  std::array<std::int64_t, 3> cells{1, 1, 1};  ///< along each axis
  double tolerance = 1e-4;                     ///< of the flow: residual over what drives it [1]
  std::int64_t most_iterations = 200;          ///< of a step; a run that needs more ends
  double courant = 0.5;                        ///< largest share of a cell that a step carries melt [1]
  double diffusivity = 0;                      ///< kappa [m^2/s]; 0: there is no heat
  double expansion = 0;                        ///< alpha: rho = rho_0 (1 - alpha (T - T_0)) [1/K]
  double reference_temperature = 0;            ///< T_0 [K]
  double viscosity_fall = 0;                   ///< b: eta = eta_0 exp(-b (T - T_0)) [1/K]
  MeltStart start;
  std::vector<MeltSide> sides;
  friend bool operator==(const MeltControl&, const MeltControl&) = default;
};

}  // namespace sph
