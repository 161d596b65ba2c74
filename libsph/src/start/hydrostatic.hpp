// Pressure of still layers under their own weight: dp/dd = rho(p) g along the depth d, each layer with its
// own equation of state, less what a background bears (laws/background.hpp). Closed form where the law has one; else a table of Runge-Kutta steps of fixed
// length, so that the pressure at a point depends on nothing but the scene.
#pragma once

#include <vector>

#include "sph/laws/eos/law.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

class HydrostaticColumn {
 public:
  /// Of scene.start.layers, which must not be empty, in a scene with gravity. Throws InputError where a layer
  /// that needs pressure begins without pressure: it would be all gas.
  explicit HydrostaticColumn(const Scene& scene);

  /// At a point [m], above the surface pressure [Pa].
  [[nodiscard]] double operator()(const Double3& x) const;

 private:
  struct Part {
    const Group* fluid;
    double top;       ///< height [m]
    double pressure;  ///< there, above the surface pressure [Pa]
    /// Where the law has no closed form: absolute pressures every `step_` from the top on [Pa].
    std::vector<double> below = {};
  };
  [[nodiscard]] double at_depth(const Part& part, double depth) const;
  [[nodiscard]] double descend(const Group& fluid, double pressure, double way) const;

  /// What the equation of state sees besides the pressure.
  [[nodiscard]] double outer(const Part& part, double depth) const;
  [[nodiscard]] double pull_on(const Group& fluid) const;  ///< [m/s^2]
  [[nodiscard]] double height(const Double3& x) const;     ///< against gravity [m]

  Double3 pull_;
  const Scene* scene_;
  double gravity_, step_;
  std::vector<Part> parts_;
};

}  // namespace sph
