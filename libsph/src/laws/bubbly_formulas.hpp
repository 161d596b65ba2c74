// Bubbly magma of which some is gas, 0 < p < p_sat, Ida (2009) eqs. (12)-(15), for one particle or for a vector of them: each
// operation is one of IEEE, so that both give the same bits. Everything is written with p/rho instead of 1/rho, so that nothing
// divides by a pressure or overflows as the gas gets thin: p/rho = (1-xi) p/rho_l + xi RT, with 1-xi = (1+m_d)/(1+m) and
// xi = (m-m_d)/(1+m).
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "sph/core/exact_math.hpp"
#include "sph/core/simd.hpp"

namespace sph {

/// V: double or Simd<double>, the latter for gamma = 1 and 0.5 alone.
template <class V>
struct BubblyFormulas {
  double rho0, k, rt, ps, gamma;
  V m;

  struct Saturation {
    V pressure, density;
  };
  [[nodiscard]] Saturation saturation() const {
    const V p = gamma == 1 ? ps * m : gamma == 0.5 ? ps * (m * m) : ps * power(m, 1.0 / gamma);
    return {p, rho0 * (1.0 + p / k)};
  }
  [[nodiscard]] V dissolved(V p) const {
    const V ratio = p / ps;
    if (gamma == 1) return ratio;
    if (gamma == 0.5) return root(ratio);
    return power(ratio, gamma);
  }
  [[nodiscard]] V density(V p) const {
    const V md = dissolved(p), liquid = (1.0 + md) * (p / (rho0 * (1.0 + p / k)));
    return (1.0 + m) * (p / (liquid + not_negative(m - md) * rt));
  }
  [[nodiscard]] V void_fraction(V p) const {
    const V md = dissolved(p), liquid = (1.0 + md) * (p / (rho0 * (1.0 + p / k)));
    const V gas = not_negative(m - md) * rt;
    return gas / (liquid + gas);
  }
  // With e = p/rho, c^2 = dp/drho = e^2 / (e - p de/dp).
  [[nodiscard]] V sound_speed(V p) const {
    const V md = dissolved(p), compression = 1.0 + p / k, p_by_rho_l = p / (rho0 * compression);
    const V gas = not_negative(m - md) * rt, e = (1.0 + md) * p_by_rho_l + gas;
    const V stiffness = (1.0 + md) * p_by_rho_l * (p / k) / compression + gas;
    const V exsolution = gamma * md * (rt - p_by_rho_l);
    return e / root((1.0 + m) * (stiffness + exsolution));
  }

  // Closed form with rho_l = rho_0. In y = p/p_sat and neglecting the volume change of the melt by dissolution,
  // y^gamma + a y = 1 with a = ((1+m)/rho - 1/rho_0) p_sat/(m RT); 1/a is the dilute limit. All times rho.
  [[nodiscard]] V first_guess(V rho, V p_sat) const {
    const V free = not_negative((1.0 + m) - rho / rho0), gas = rho * m * rt;
    if (gamma == 1) {
      // Exact for rho_l = rho_0: p^2/(p_s rho_0) - B p + m RT = 0, the stable root.
      const V b = free + rho * (rt / ps);
      return 2.0 * gas / (b + root(not_negative(b * b - 4.0 * gas * (rho / (ps * rho0)))));
    }
    if (gamma == 0.5) {
      // free p + (rho RT/sqrt(p_s)) sqrt(p) = gas
      const V b = rho * rt / std::sqrt(ps);
      const V s = 2.0 * gas / (b + root(b * b + 4.0 * free * gas));
      return s * s;
    }
    // The root for gamma = 1, right in both limits for any gamma.
    return gas * (p_sat / (gas + free * p_sat));
  }
  /// h(p) = rho ((1+m_d) p/rho_l + (m-m_d) RT) - (1+m) p and p dh/dp.
  struct Balance {
    V h, slope;
  };
  [[nodiscard]] Balance balance(V rho, V p) const {
    const V md = dissolved(p), compression = 1.0 + p / k, p_by_rho_l = p / (rho0 * compression);
    return {rho * ((1.0 + md) * p_by_rho_l + (m - md) * rt) - (1.0 + m) * p,
            rho * ((1.0 + md) * p_by_rho_l / compression + gamma * md * (p_by_rho_l - rt)) - (1.0 + m) * p};
  }

 private:
  static V root(V x) {
    using std::sqrt;
    return sqrt(x);
  }
  static V not_negative(V x) {
    using std::max;
    return max(x, V(0.0));
  }
  static V power(V x, double n) {
    if constexpr (std::is_same_v<V, double>)
      return exact_pow(x, n);
    else
      return x;
  }
};

// Newton's last step is below this, so that the next one would change p by its square: round-off.
inline constexpr double bubbly_tolerance = 1e-8;
inline constexpr int most_bubbly_steps =
    100;  // a backstop: tests see at most 10, and at most 4 for 0.5 <= gamma <= 1.5

}  // namespace sph
