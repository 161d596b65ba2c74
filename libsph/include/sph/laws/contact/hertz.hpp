// HertzNormal  F = 4/3 E* sqrt(R*) d^1.5 - c v,  c = 2 sqrt(5/6) beta sqrt(S m*), S = 2 E* sqrt(R* d),
//              k_t = 8 G* sqrt(R* d)      (Hertz 1882; Mindlin 1949; Tsuji et al. 1992)
// 1/E* = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2, 1/G* likewise of (2 - nu)/G. The dashpot is that of linear.hpp
// with the stiffness of now.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "sph/laws/contact/law.hpp"
#include "sph/laws/contact/restitution.hpp"

namespace sph {

struct HertzNormal : NormalLaw {
  static constexpr std::string_view word = "hertz", name = "Hertz";
  static constexpr std::array keys{
      LawKey{.name = "young_modulus",
             .dimension = dimension::pressure,
             .sentence = "1 / E* = (1 - nu_1^2) / E_1 + (1 - nu_2^2) / E_2."},
      LawKey{.name = "poisson_ratio", .above = -1, .most = 0.5, .sentence = "nu."}};
  static constexpr bool dashpot = true;
  static constexpr ReducedImpact impact{5.0 / 6.0, 8.0 / 15.0, 2.0 / 3.0,
                                        [](double x) { return std::sqrt(x); }, 0.2};

  template <class V>
  static NormalForce<V> force(const Contact<V>& c, const ContactConstants<V>& k) {
    NormalForce<V> f;
    const V overlap = max(V(0.0), c.overlap);
    const V patch = sqrt(c.radius * overlap);  // radius of the contact area [m]
    const V tangent = V(2.0) * k.stiffness * patch;
    f.dashpot = k.damping * sqrt(tangent * c.mass) + k.damping_change * tangent;
    f.elastic = V(2.0 / 3.0) * tangent * overlap;
    f.force = max(k.least_force, f.elastic - f.dashpot * c.separation);
    f.shear_stiffness = V(8.0) * k.shear_stiffness * patch;
    // The overlap a step ago from the present velocity: no further history.
    const V before = overlap + max(V(0.0), c.separation * c.dt);
    f.shear_change = sqrt(overlap / max(before, V(1e-300)));
    return f;
  }
  /// 8/15 E* sqrt(R*) d^(5/2)
  template <class V>
  static V energy(const Contact<V>& c, const ContactConstants<V>& /*k*/, const NormalForce<V>& f) {
    return V(0.4) * f.elastic * c.overlap;
  }

  static PairConstants constants(const MaterialPair& p) {
    const auto compliance = [](const LawConstants& g) { return (1 - g[1] * g[1]) / g[0]; };
    const auto shear_compliance = [](const LawConstants& g) {  // (2 - nu) / G, G = E / (2 (1 + nu))
      return (2 - g[1]) * 2 * (1 + g[1]) / g[0];
    };
    return {1 / (compliance(p.a) + compliance(p.b)), 1 / (shear_compliance(p.a) + shear_compliance(p.b)),
            damping_of(impact, p.pull, p.restitution),
            damping_change_of(impact, p.pull, p.restitution, p.dt)};
  }
  static double stiffness(const PairConstants& k, double radius, double overlap) {
    return 2 * k.stiffness * std::sqrt(overlap * radius);
  }
  static double shear_stiffness(const PairConstants& k, double stiffness) {
    return 4 * k.shear_stiffness / k.stiffness * stiffness;
  }
  static double damping_share(double damping, double /*stiffness*/, double /*mass*/) { return 0.5 * damping; }
  /// Of the least time that a surface wave takes along half a grain.
  static LawSteps steps(const LightGrains& grains) {
    double rayleigh = std::numeric_limits<double>::infinity();
    for (const Group& g : grains.groups)
      if (g.grain.least_radius > 0 && !g.grain.fixed)
        rayleigh = std::min(rayleigh, rayleigh_time(g.grain.least_radius, g.density, g.grain.constants[0],
                                                    g.grain.constants[1]));
    return {0.15 * rayleigh, 0.2 * rayleigh};
  }
};

}  // namespace sph
