// What a scene says of where particles come in and leave: [[inlet]], [[insertion]] and [[outlet]].
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "sph/scene/time_curve.hpp"

namespace sph {

/// Along an axis, up or down.
enum class Direction : std::uint8_t { x_up, x_down, y_up, y_down, z_up, z_down };
[[nodiscard]] inline std::size_t axis_of(Direction d) { return static_cast<std::size_t>(d) / 2; }
[[nodiscard]] inline bool is_up(Direction d) { return static_cast<int>(d) % 2 == 0; }

/// How fast it flows in across an inlet, over the mean: the same, or a parabola between faces that are no period.
enum class InletProfile : std::uint8_t { uniform, parabolic };

/// A box full of fluid, lower <= x < upper [m], that moves on along `direction`: what passes its end is free, and
/// another particle follows at its beginning.
struct Inlet {
  std::array<double, 3> lower{}, upper{};
  Direction direction = Direction::x_up;
  int group = -1;
  TimeCurve velocity;  ///< mean of it [m/s]; empty: it follows from what is beside, and `pressure` is given
  TimeCurve pressure;  ///< at the middle of the box [Pa]; empty: it follows from what is beside
  InletProfile profile = InletProfile::uniform;
  std::optional<double> temperature;  ///< of what comes in [K]; that of the group
  std::optional<double> gas_content;  ///< ... [1]
  friend bool operator==(const Inlet&, const Inlet&) = default;
};

/// A box into which grains come, at random places where they touch nothing.
struct Insertion {
  std::array<double, 3> lower{}, upper{};  ///< grains fit in [m]
  int group = -1;
  TimeCurve rate;                    ///< mass that comes in per time [kg/s]
  std::array<double, 3> velocity{};  ///< with which [m/s]
  double every = 0;                  ///< what comes in between is put there at once [s]
  friend bool operator==(const Insertion&, const Insertion&) = default;
};

/// A box in which particles are deleted. With a pressure it is led on to the box's end first, and lets sound out.
struct Outlet {
  std::array<double, 3> lower{}, upper{};
  Direction direction = Direction::x_up;  ///< with a pressure
  TimeCurve pressure;                     ///< at the middle of the box [Pa]; empty: it is deleted at once
  double settle_time = 0;                 ///< how fast the pressure returns to that [s]
  double every = 0;  ///< grains in it are deleted at once so often [s]; 0: after each step
  static constexpr double settles_in = 100;  ///< h / c: what is beside boxes is a mean over so long
  friend bool operator==(const Outlet&, const Outlet&) = default;
};

struct OpeningControl {
  std::vector<Inlet> inlets;
  std::vector<Outlet> outlets;
  std::vector<Insertion> insertions;
  std::array<bool, 6> deletes{};  ///< what leaves through x0, x1, y0, ... is no more; else it ends the run

  /// Particles come or go.
  [[nodiscard]] bool any() const;
  /// Some are led in boxes.
  [[nodiscard]] bool lead() const;
  /// Of Throughput::passages: they come in through this one.
  [[nodiscard]] bool comes_in(std::size_t passage) const {
    return passage < inlets.size() || passage > inlets.size() + outlets.size();
  }
  friend bool operator==(const OpeningControl&, const OpeningControl&) = default;
};

}  // namespace sph
