// Where and how long a scene lasts, and how its matter is smoothed: [domain], [kernel] and [time].
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "sph/scene/grain_scene.hpp"
#include "sph/scene/melt_scene.hpp"
#include "sph/scene/opening_scene.hpp"
#include "sph/scene/reset_scene.hpp"

namespace sph {

/// Matter at rest that pressures are the excess over: its weight is taken from all other.
struct Background {
  double density = 0;  ///< rho_b; 0: there is none [kg/m^3]
  double surface = 0;  ///< height against gravity where its pressure is that of the surface [m]
  friend bool operator==(const Background&, const Background&) = default;
};

/// The box that holds everything, and what acts on all of it.
struct Domain {
  Double3 lower{}, upper{};  ///< [m]
  std::array<bool, 3> periodic{};
  Double3 gravity{};            ///< [m/s^2]
  double central_pull = 0;      ///< acceleration towards pull_centre over the distance from it [1/s^2]
  Double3 pull_centre{};        ///< [m]
  double surface_pressure = 0;  ///< added to the pressure of every equation of state [Pa]
  Background background;
  std::vector<Reset> resets;  ///< in their order
  OpeningControl openings;
  MeltControl melt;  ///< that fills it
  friend bool operator==(const Domain&, const Domain&) = default;
};

enum class KernelShape { quintic, wendland_c2, wendland_c4 };

/// Of fluids and solids.
struct KernelControl {
  KernelShape shape = KernelShape::quintic;
  double smoothing_length = 0;  ///< h [m]; quintic support 3h, Wendland 2h
  // Of the smoothing length of a particle of an ideal gas, over h.
  double least_growth = 1, largest_growth = 1;
  friend bool operator==(const KernelControl&, const KernelControl&) = default;
};

struct TimeControl {
  std::optional<double> dt;     ///< fixed step [s]; otherwise from cfl
  double cfl = 0.8;             ///< dt = cfl h / (c + u)
  std::optional<double> until;  ///< stop at the first step with t >= until [s]
  std::optional<std::int64_t> steps;
  friend bool operator==(const TimeControl&, const TimeControl&) = default;
};

/// An end that is given beside a scene, instead of the scene's own.
struct End {
  std::optional<double> until;        ///< as TimeControl has it
  std::optional<std::int64_t> steps;  ///< ... too
};

}  // namespace sph
