// Eight pairs of touching bodies at once, one a lane, moved as the library moves grains: forces from x^n and
// v^(n-1/2), then v += F/m dt, then x += v dt. A pair is all there is: no lists, no fixed point, no sums.
#pragma once

#include <cmath>
#include <numbers>

#include "sph/core/simd.hpp"
#include "sph/laws/contact/hertz.hpp"
#include "sph/laws/contact/linear.hpp"
#include "sph/pairs/contact.hpp"
#include "sph/pairs/contact_pass.hpp"
#include "sph/pairs/friction.hpp"
#include "sph/pairs/rolling.hpp"

namespace sph::test {

using V = Simd<double>;
using V3 = V[3];

/// A lane-by-lane value.
template <class F>
V lanes(F value) {
  V v = V::zero();
  for (int l = 0; l < V::lanes; ++l) v.set(l, value(l));
  return v;
}

inline V where_positive(V condition, V x) { return where_less(V::zero(), condition, x); }

inline void cross(const V3& a, const V3& b, V3& c) {
  for (int d = 0; d < 3; ++d) c[d] = a[(d + 1) % 3] * b[(d + 2) % 3] - a[(d + 2) % 3] * b[(d + 1) % 3];
}
inline V dot(const V3& a, const V3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline V norm(const V3& a) { return sqrt(dot(a, a)); }

struct Body {
  V3 x{V::zero(), V::zero(), V::zero()}, v{V::zero(), V::zero(), V::zero()},
      w{V::zero(), V::zero(), V::zero()};
  V radius = 1.0, inverse_mass = 1.0;
  [[nodiscard]] V inverse_inertia() const { return V(2.5) * inverse_mass / (radius * radius); }
};

/// What acts on j, and its opposite on i: forces, and torques that are the same up to the arm.
struct Load {
  V3 force{V::zero(), V::zero(), V::zero()}, twist{V::zero(), V::zero(), V::zero()},
      rolling{V::zero(), V::zero(), V::zero()};
};

template <class Normal, class Friction = Coulomb, class Rolling = NoRolling>
struct Pair {
  Body i, j;
  bool wall = false;  ///< i is a plane through i.x with the normal +y, and moves as it is told
  ContactConstants<V> k{V::zero(), V::zero(), V::zero(), V::zero(), V::zero(),
                        V::zero(), V::zero(), V::zero(), V::zero()};
  V3 gravity{V::zero(), V::zero(), V::zero()};
  V dt = 1e-3;
  V3 spring{V::zero(), V::zero(), V::zero()}, roll_spring{V::zero(), V::zero(), V::zero()};
  V memory[Normal::history.size() + 1]{};  ///< of the normal law
  V largest_overlap = V::zero(), largest_force = V::zero(), steps_in_touch = V::zero();
  Contact<V> contact{};
  NormalForce<V> normal{};

  void look() {
    V3 d;
    for (int a = 0; a < 3; ++a) d[a] = j.x[a] - i.x[a];
    const V distance = wall ? d[1] : norm(d);
    for (int a = 0; a < 3; ++a) contact.normal[a] = wall ? V(a == 1 ? 1.0 : 0.0) : d[a] / distance;
    contact.overlap = (wall ? j.radius : i.radius + j.radius) - distance;
    contact.radius = wall ? j.radius : i.radius * j.radius / (i.radius + j.radius);
    contact.mass = V(1.0) / (wall ? j.inverse_mass : i.inverse_mass + j.inverse_mass);
    contact.dt = dt;
    V3 relative, surface, roll, turned;
    for (int a = 0; a < 3; ++a) {
      relative[a] = j.v[a] - i.v[a];
      roll[a] = j.w[a] - i.w[a];
      surface[a] = wall ? j.radius * j.w[a] : j.radius * j.w[a] + i.radius * i.w[a];
    }
    contact.separation = dot(relative, contact.normal);
    cross(surface, contact.normal, turned);
    const V along = dot(roll, contact.normal);
    for (int a = 0; a < 3; ++a) {
      contact.slip[a] = relative[a] - contact.separation * contact.normal[a] - turned[a];
      contact.roll[a] = roll[a] - along * contact.normal[a];
    }
  }

  /// The contact of the present state; forgets the history of lanes that do not touch.
  Load load() {
    look();
    normal = normal_force<Normal>(contact, k, memory);
    Load out;
    const V touch = contact.overlap;
    V3 tangent{V::zero(), V::zero(), V::zero()}, rolling{V::zero(), V::zero(), V::zero()};
    if constexpr (Friction::history > 0) Friction::force(contact, k, normal, spring, tangent);
    if constexpr (Rolling::history > 0)
      Rolling::torque(contact, k, normal, Normal::rolling_change(contact, k, normal, memory), roll_spring,
                      rolling);
    cross(contact.normal, tangent, out.twist);
    for (V& m : memory) m = where_positive(touch, m);
    for (int a = 0; a < 3; ++a) {
      spring[a] = where_positive(touch, spring[a]);
      roll_spring[a] = where_positive(touch, roll_spring[a]);
      out.force[a] = where_positive(touch, normal.force * contact.normal[a] + tangent[a]);
      out.twist[a] = where_positive(touch, out.twist[a]);
      out.rolling[a] = where_positive(touch, rolling[a]);
    }
    largest_overlap = max(largest_overlap, touch);
    largest_force = max(largest_force, where_positive(touch, normal.force));
    steps_in_touch += where_positive(touch, V(1.0));
    return out;
  }

  void step() {
    const Load on_j = load();
    for (int a = 0; a < 3; ++a) {
      j.v[a] += dt * (on_j.force[a] * j.inverse_mass + gravity[a]);
      j.w[a] += dt * j.inverse_inertia() * (on_j.rolling[a] - j.radius * on_j.twist[a]);
      if (!wall) {
        i.v[a] += dt * (gravity[a] - on_j.force[a] * i.inverse_mass);
        i.w[a] -= dt * i.inverse_inertia() * (on_j.rolling[a] + i.radius * on_j.twist[a]);
      }
      j.x[a] += dt * j.v[a];
      i.x[a] += dt * i.v[a];
    }
  }

  void steps(int count) {
    for (int n = 0; n < count; ++n) step();
  }

  /// Without the energy of the contact.
  [[nodiscard]] V kinetic_energy() const {
    const auto of = [](const Body& b) {
      return V(0.5) * (dot(b.v, b.v) / b.inverse_mass + dot(b.w, b.w) / b.inverse_inertia());
    };
    return wall ? of(j) : of(i) + of(j);
  }
};

/// Kinetic energy at the time of the forces, and that of the springs: what may only fall. `before`: the pair
/// before the step that led to `after`.
template <class Normal, class Friction, class Rolling>
V whole_energy(const Pair<Normal, Friction, Rolling>& before, const Pair<Normal, Friction, Rolling>& after) {
  Pair<Normal, Friction, Rolling> middle = after;
  for (int a = 0; a < 3; ++a) {
    middle.i.v[a] = V(0.5) * (before.i.v[a] + after.i.v[a]);
    middle.j.v[a] = V(0.5) * (before.j.v[a] + after.j.v[a]);
    middle.i.w[a] = V(0.5) * (before.i.w[a] + after.i.w[a]);
    middle.j.w[a] = V(0.5) * (before.j.w[a] + after.j.w[a]);
  }
  const V overlap = after.contact.overlap;
  const V stored = Normal::energy(after.contact, after.k, after.normal) +
                   V(0.5) * dot(after.spring, after.spring) / max(after.normal.shear_stiffness, V(1e-300));
  return middle.kinetic_energy() + where_positive(overlap, stored);
}

struct Material {
  double young_modulus, poisson_ratio, density, friction = 0, restitution = 1;
  [[nodiscard]] double shear_modulus() const { return young_modulus / (2 * (1 + poisson_ratio)); }
  [[nodiscard]] double mass(double radius) const {
    return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius * density;
  }
  /// Of a contact with something rigid; two materials are in series.
  [[nodiscard]] double contact_modulus() const { return young_modulus / (1 - poisson_ratio * poisson_ratio); }
  [[nodiscard]] double contact_shear() const { return shear_modulus() / (2 - poisson_ratio); }
};

inline double series(double a, double b) { return a * b / (a + b); }

}  // namespace sph::test
