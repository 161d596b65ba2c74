// What a scene says of boxes in which particles get another state: [[reset]].
#pragma once

#include <array>
#include <optional>

namespace sph {

/// Lower <= x < upper [m]. Where an old temperature or gas content leaves through a period, the new one comes in.
struct Reset {
  std::array<double, 3> lower{}, upper{};
  std::optional<double> temperature;  ///< of fluids and solids with heat [K] ...
  std::optional<double> gas_content;  ///< ... and of bubbly fluids [1]: one of the two at least
  friend bool operator==(const Reset&, const Reset&) = default;
};

}  // namespace sph
