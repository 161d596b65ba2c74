// LinearNormal  F = k_n d - c v,   c = 2 zeta sqrt(k_n m*)             (Cundall & Strack 1979)
// LinearRate    F = k_n d - gamma_n m* v                               (Silbert et al. 2001, eq. 1)
// The dashpot c gives the restitution e that restitution.hpp finds c for; `least_force` = 0 cuts off its pull
// at the end of a contact. max() is called so that a NaN comes through. The dashpot sees the velocity half a
// step late: with c it acts as c (1 + c dt / 2 m*). What is taken off it for that is of the order c^2 dt/m*,
// in which the mass drops out: damping_change times the stiffness, with a factor from restitution.hpp that
// makes e right in the mean over the ways to fall between two steps.
#pragma once

#include <cmath>

#include "sph/laws/contact/law.hpp"
#include "sph/laws/contact/restitution.hpp"

namespace sph {

template <class V>
NormalForce<V> linear_force(const Contact<V>& c, const ContactConstants<V>& k, V dashpot) {
  NormalForce<V> f;
  f.elastic = k.stiffness * c.overlap;
  f.force = max(k.least_force, f.elastic - dashpot * c.separation);
  f.shear_stiffness = k.shear_stiffness;
  f.shear_change = V(1.0);
  f.dashpot = dashpot;
  return f;
}

/// Springs of two materials.
struct Springs : NormalLaw {
  static constexpr std::string_view word = "linear", name = "linear";
  // 2/7: both springs of an impact then swing back together.
  static constexpr std::array keys{
      LawKey{.name = "normal_stiffness",
             .dimension = dimension::stiffness,
             .sentence =
                 "k_n of two grains of this material. Between materials the harmonic mean 2 k_1 k_2 / "
                 "(k_1 + k_2)."},
      LawKey{.name = "tangential_stiffness",
             .dimension = dimension::stiffness,
             .otherwise = [](const LawConstants& k) { return 2 * (k[0] / 7); },
             .sentence = "k_t, between materials alike.",
             .default_text = "2/7 normal_stiffness"}};
  /// k_n and k_t, in series.
  static std::array<double, 2> springs(const MaterialPair& p) {
    return {in_series(p.a[0], p.b[0]), in_series(p.a[1], p.b[1])};
  }
  template <class V>
  static V energy(const Contact<V>& c, const ContactConstants<V>& /*k*/, const NormalForce<V>& f) {
    return V(0.5) * f.elastic * c.overlap;
  }
};

struct LinearRate : Springs {
  static constexpr bool dashpot = true;

  template <class V>
  static NormalForce<V> force(const Contact<V>& c, const ContactConstants<V>& k) {
    return linear_force(c, k, k.damping * c.mass);
  }
  static PairConstants constants(const MaterialPair& p) {
    const auto [normal, shear] = springs(p);
    return {normal, shear, p.rate};
  }
  static double damping_share(double rate, double stiffness, double mass) {
    return 0.5 * rate * std::sqrt(mass / stiffness);
  }
};

struct LinearNormal : Springs {
  static constexpr bool dashpot = true;
  using ByRate = LinearRate;
  static constexpr ReducedImpact impact{1.0, 1.0, 1.0, [](double) { return 1.0; }, 0.11};

  template <class V>
  static NormalForce<V> force(const Contact<V>& c, const ContactConstants<V>& k) {
    return linear_force(c, k, k.damping * sqrt(k.stiffness * c.mass) + k.damping_change * k.stiffness);
  }
  static PairConstants constants(const MaterialPair& p) {
    const auto [normal, shear] = springs(p);
    return {normal, shear, damping_of(impact, p.pull, p.restitution),
            damping_change_of(impact, p.pull, p.restitution, p.dt)};
  }
  static double damping_share(double damping, double /*stiffness*/, double /*mass*/) { return 0.5 * damping; }
};

}  // namespace sph
