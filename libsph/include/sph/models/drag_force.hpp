// The force of a fluid on one grain in it, from the fluid's averages around it: see models/drag.hpp.
#pragma once

#include "sph/scene/grain_mass.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

/// What the fluid around a grain is, on average over the kernel.
struct FluidAround {
  double immersed = 0;   ///< share of the grain that is in it
  Double3 velocity{};    ///< [m/s]
  Double3 stress{};      ///< force of the fluid's stress on a volume [N/m^3]
  double porosity = 1;   ///< what the grain itself takes up included
  double own = 0;        ///< of 1 - porosity: what the grain itself makes of it
  double density = 0;    ///< of the fluid itself [kg/m^3]
  double viscosity = 0;  ///< [Pa s]
  double sound = 0;      ///< the fastest [m/s]
};

struct GrainInFluid {
  double diameter, mass;
  const double* v;
  bool fixed;
};

/// What bounds the time step.
struct PushLimits {
  double rate = 0;   ///< at which grains like this one take the fluid along [1/s]
  double sound = 0;  ///< of the mixture [m/s]
};

struct Push {
  Double3 force;  ///< [N]
  Double3 drag;   ///< its part that is not stress [N]
  PushLimits limits;
};

[[nodiscard]] constexpr double volume_of(double radius) { return grain_mass(1, radius); }

class DragForce {
 public:
  static constexpr double packed = 0.35;  ///< porosity of a bed
  /// Of the rate at which drag takes the fluid along, in a time step: what is usual, and the most. Beyond 2/3 the
  /// guess of what grains do to the fluid would amplify itself.
  static constexpr double usual_share = 0.3, largest_share = 0.6;

  explicit DragForce(const Scene& scene);
  [[nodiscard]] Push operator()(const FluidAround& around, const GrainInFluid& grain, double dt) const;

 private:
  const Scene* scene_;
  const DragLaw* law_;
  double self_mobility_;
};

}  // namespace sph
