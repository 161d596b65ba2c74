// A contact law of the consumer's own: springs that stiffen, F = k d (1 + d^2/l^2) - c v, and the largest
// overlap that a contact has had, on which nothing depends but the bits of its history.
#pragma once

#include "sph/laws/contact/registry.hpp"

struct Stiffening : sph::NormalLaw {
  static constexpr std::string_view word = "stiffening", name = "stiffening";
  static constexpr std::array keys{sph::LawKey{"soft_stiffness", sph::dimension::stiffness},
                                   sph::LawKey{"hard_overlap", sph::dimension::length}};
  static constexpr std::array history{sph::Parity::even};
  static constexpr bool dashpot = true;

  template <class V>
  static sph::NormalForce<V> force(const sph::Contact<V>& c, const sph::ContactConstants<V>& k, V* largest) {
    largest[0] = max(largest[0], c.overlap);
    const V ratio = c.overlap / k.damping_change;
    sph::NormalForce<V> f;
    f.elastic = k.stiffness * c.overlap * (V(1.0) + ratio * ratio);
    f.dashpot = k.damping * sqrt(k.stiffness * c.mass);
    f.force = max(k.least_force, f.elastic - f.dashpot * c.separation);
    f.shear_stiffness = k.shear_stiffness;
    f.shear_change = V(1.0);
    return f;
  }
  /// F/d = k (1 + d^2/l^2), now and where the overlap was a step ago.
  template <class V>
  static V rolling_change(const sph::Contact<V>& c, const sph::ContactConstants<V>& k,
                          const sph::NormalForce<V>&, const V* /*largest*/) {
    const V square = k.damping_change * k.damping_change;
    const V before = c.overlap + max(V(0.0), c.separation * c.dt);
    return (square + c.overlap * c.overlap) / (square + before * before);
  }
  template <class V>
  static V energy(const sph::Contact<V>& c, const sph::ContactConstants<V>& k, const sph::NormalForce<V>&) {
    const V square = c.overlap * c.overlap;
    return k.stiffness * square * (V(0.5) + V(0.25) * square / (k.damping_change * k.damping_change));
  }
  static sph::PairConstants constants(const sph::MaterialPair& p) {
    const double stiffness = in_series(p.a[0], p.b[0]);
    return {stiffness, 0.5 * stiffness, 1 - p.restitution, in_series(p.a[1], p.b[1])};
  }
  static double stiffness(const sph::PairConstants& k, double /*radius*/, double overlap) {
    const double ratio = overlap / k.damping_change;
    return k.stiffness * (1 + 3 * ratio * ratio);
  }
  static double damping_share(double damping, double /*stiffness*/, double /*mass*/) { return 0.5 * damping; }
};
