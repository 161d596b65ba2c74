// Bubbly magma of which w is dissolved, whatever its pressure would have: Ida (2009) eqs. (12)-(15) with w instead of m_d,
//   (1 + m) / rho = (1 + w) / rho_l + (m - w) RT / p,   rho_l = rho_0 (1 + p/K),
// a quadratic in p. Where w = m, that of the liquid, tension included.
#pragma once

#include <algorithm>
#include <cmath>

#include "sph/scene/scene.hpp"

namespace sph {

class SlowBubblyEos {
 public:
  SlowBubblyEos(const Group& g, double gas_content, double dissolved)
      : rho0_(g.density),
        k_(g.eos.bulk_modulus),
        m_(gas_content),
        w_(std::min(dissolved, gas_content)),
        rt_(g.bubbly.gas_rt) {}

  // The positive root of a p^2 + ((a - b) K - g) p - g K = 0, a = (1+m)/rho, b = (1+w)/rho_0, g = (m-w) RT.
  [[nodiscard]] double pressure(double density) const {
    const double a = (1 + m_) / density, b = (1 + w_) / rho0_, g = (m_ - w_) * rt_;
    const double half = 0.5 * (g - (a - b) * k_);
    if (g == 0) return k_ * (b / a - 1);
    const double root = std::sqrt(half * half + a * g * k_);
    return half > 0 ? (half + root) / a : g * k_ / (root - half);
  }
  [[nodiscard]] double density(double pressure) const {
    if (m_ == w_) return rho0_ * (1 + pressure / k_);
    const double p = std::max(pressure, 0.0), liquid = (1 + w_) * (p / (rho0_ * (1 + p / k_)));
    return (1 + m_) * (p / (liquid + (m_ - w_) * rt_));
  }
  [[nodiscard]] double void_fraction(double pressure) const {
    if (m_ == w_) return 0;
    const double p = std::max(pressure, 0.0), gas = (m_ - w_) * rt_;
    return gas / ((1 + w_) * (p / (rho0_ * (1 + p / k_))) + gas);
  }
  /// Of waves that are too quick for gas to come out of solution.
  [[nodiscard]] double sound_speed(double pressure) const {
    if (m_ == w_) return std::sqrt(k_ / rho0_);
    const double p = std::max(pressure, 0.0), liquid = (1 + w_) * (p / (rho0_ * (1 + p / k_)));
    const double gas = (m_ - w_) * rt_;
    return (liquid + gas) / std::sqrt((1 + m_) * (liquid * (p / k_) / (1 + p / k_) + gas));
  }
  /// As BubblyEos has it.
  [[nodiscard]] double gas_stiffness(double pressure) const {
    return (1 + m_) / density(pressure) * (rt_ / pressure) / compliance(pressure);
  }
  /// -dp/dw at constant density: what goes into solution is missed in the bubbles [Pa].
  [[nodiscard]] double relief(double pressure) const {
    return std::max(rt_ / pressure - 1 / (rho0_ * (1 + pressure / k_)), 0.0) / compliance(pressure);
  }

 private:
  /// -d((1 + m) / rho) / dp
  [[nodiscard]] double compliance(double p) const {
    return (1 + w_) / rho0_ * (k_ / ((k_ + p) * (k_ + p))) + (m_ - w_) * rt_ / (p * p);
  }

  double rho0_, k_, m_, w_, rt_;
};

}  // namespace sph
