// What a contact law sees of two touching spheres, or of a sphere and a wall, and what it answers. Oriented
// from i to j; every law is exactly odd under the exchange of i and j (forces and torques change sign, bit
// for bit, and a history by its parity), so both owners of a pair across ranks compute the same contact.
#pragma once

#include <array>
#include <cstdint>

namespace sph {

/// Kinematics of contacts, one a lane. Values of lanes that do not touch are meaningless, never used.
template <class V>
struct Contact {
  V overlap;     ///< delta = r_i + r_j - |x_j - x_i|, > 0 where they touch [m]
  V normal[3];   ///< unit vector from i to j
  V separation;  ///< (v_j - v_i).n: negative while they approach [m/s]
  V slip[3];     ///< velocity of j's surface relative to i's in the contact plane [m/s]
  V roll[3];     ///< omega_j - omega_i without its part along n [rad/s]
  V radius;      ///< r_i r_j / (r_i + r_j); against a wall r_i [m]
  V mass;        ///< m_i m_j / (m_i + m_j); against a wall m_i [kg]
  V dt;          ///< [s]
};

/// Not a loop: see Simd.
template <class V>
[[gnu::always_inline]] inline void cross(const V (&a)[3], const V (&b)[3], V (&out)[3]) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}

/// separation, slip and roll, from the relative velocity, r_i omega_i + r_j omega_j, and omega_j - omega_i in roll.
template <bool spins, class V>
[[gnu::always_inline]] inline void set_motion(Contact<V>& contact, const V (&rel)[3], const V (&surface)[3]) {
  const V(&n)[3] = contact.normal;
  contact.separation = rel[0] * n[0] + rel[1] * n[1] + rel[2] * n[2];
  if constexpr (spins) {
    const V along = contact.roll[0] * n[0] + contact.roll[1] * n[1] + contact.roll[2] * n[2];
    V turned[3];
    cross(surface, n, turned);
    for (int a = 0; a < 3; ++a) {
      contact.slip[a] = rel[a] - contact.separation * n[a] - turned[a];
      contact.roll[a] -= along * n[a];
    }
  }
}

/// Constants of a pair of materials; which of them mean what is said by the laws.
template <class V>
struct ContactConstants {
  V stiffness;         ///< linear: k_n [N/m]; Hertz: E* [Pa]; Walton-Braun: k_2 [N/m]
  V shear_stiffness;   ///< linear: k_t [N/m]; Hertz: G* [Pa]
  V damping;           ///< of the normal law, by which it loses energy: see there
  V shear_damping;     ///< of the normal dashpot, 0 to 1
  V friction;          ///< mu
  V rolling_friction;  ///< mu_r
  V rolling_damping;   ///< of the rolling dashpot, 0 to 1 of the critical one
  V damping_change;    ///< of the dashpot for the discrete step, times the stiffness; <= 0 [s]
  V least_force;       ///< of the normal force: 0, or minus infinity where dashpots may pull

  /// From the table of a scene, all but the last.
  static ContactConstants of_row(const V (&k)[8], V least_force) {
    return {k[0], k[1], k[2], k[3], k[4], k[5], k[6], k[7], least_force};
  }
};

/// What a normal law answers.
template <class V>
struct NormalForce {
  V force;            ///< on j along n [N]
  V elastic;          ///< its part without the dashpot [N]
  V shear_stiffness;  ///< k_t of the tangential spring now [N/m]
  V shear_change;     ///< k_t now / a step ago where it fell, else 1
  V dashpot;          ///< coefficient of the normal dashpot [kg/s]
};

/// What a component of a contact's history becomes when its partners are exchanged: forces and torques turn
/// their sign (springs, as they act on their carrier), scalars of the contact do not (a largest overlap).
enum class Parity : std::int8_t { odd = -1, even = 1 };

/// The answer of a normal law, with its history where it has one.
template <class Law, class V>
[[gnu::always_inline]] inline NormalForce<V> normal_force(const Contact<V>& c, const ContactConstants<V>& k,
                                                          V* history) {
  if constexpr (Law::history.empty())
    return Law::force(c, k);
  else
    return Law::force(c, k, history);
}

}  // namespace sph
