// What a scene says of boxes in which particles get another state: [[reset]].
#pragma once

#include <array>
#include <optional>

#include "sph/scene/time_curve.hpp"

namespace sph {

/// Lower <= x < upper [m]. Where an old temperature or gas content leaves through a period, the new one comes in.
struct Reset {
  std::array<double, 3> lower{}, upper{};
  std::optional<double> temperature;  ///< of fluids and solids with heat [K] ...
  std::optional<double> gas_content;  ///< ... of bubbly fluids [1] ...
  std::optional<double> pressure;     ///< ... of fluids [Pa] ...
  TimeCurve inflow;      ///< ... or what comes into those in it, together [kg/s]: one of the four at least
  double rise_time = 0;  ///< the pressure grows from 0 to that in so long [s]
  std::optional<double> until;  ///< then the box does nothing any more [s]
  friend bool operator==(const Reset&, const Reset&) = default;
};

}  // namespace sph
