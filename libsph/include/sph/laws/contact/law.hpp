// What the library asks of a normal contact law, all of it in the law's one header. A law is a struct:
//
//   struct MyLaw : NormalLaw {
//     static constexpr std::string_view word = "my_law", name = "my";   // of contact.law; on the screen
//     static constexpr std::array keys{LawKey{"my_stiffness", dimension::stiffness}};
//     static constexpr std::array history{Parity::even};               // optional: a double a contact each
//     template <class V>
//     static NormalForce<V> force(const Contact<V>&, const ContactConstants<V>&, V* history);
//     template <class V>
//     static V energy(const Contact<V>&, const ContactConstants<V>&, const NormalForce<V>&);
//     static PairConstants constants(const MaterialPair&);
//     ...
//   };
//
// NormalLaw has the answers that are those of a linear spring without a dashpot; a law says what differs
// (its stiffness, and how its rolling spring falls, wherever F/delta is not constant).
// Sweep, quanta, time steps, records, keys and screen follow (laws/contact/registry.hpp).
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "sph/laws/contact/time_step.hpp"
#include "sph/pairs/contact.hpp"
#include "sph/pairs/contact_context.hpp"
#include "sph/scene/law_key.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

/// What the constants of a contact are made of.
struct MaterialPair {
  const LawConstants &a, &b;  ///< of the two groups, in the order of the law's keys
  double restitution;         ///< of a head-on impact
  bool pull;                  ///< contact.pull
  double dt;                  ///< time step, 0 where what depends on it is not wanted [s]
  double rate;                ///< contact.normal_damping of the laws that take it [1/s]
};

/// A law's part of ContactConstants.
struct PairConstants {
  double stiffness, shear_stiffness, damping, damping_change = 0;
};

/// What bounds the time step of a scene: its groups, its stiffest contact and lightest mobile grain.
struct LightGrains {
  std::span<const Group> groups;
  double stiffness;  ///< [N/m]
  double mass;       ///< [kg]
};

/// Time steps that a law wants [s].
struct LawSteps {
  double recommended, advised;  ///< see GrainTimeSteps
};

struct NormalLaw {
  static constexpr std::array<Parity, 0> history{};
  /// It damps by a dashpot, of which contact.pull and contact.tangential_damping speak: other laws refuse them.
  static constexpr bool dashpot = false;
  using ByRate = void;  ///< the law that stands instead where contact.normal_damping is given

  /// dF/d(delta) of two grains of this radius at that overlap, the largest the law has there [N/m].
  static double stiffness(const PairConstants& k, double /*radius*/, double /*overlap*/) {
    return k.stiffness;
  }
  /// k_r, which follows F/delta (pairs/rolling.hpp), now / a step ago where it fell, else 1; `history` as force()
  /// leaves it. Here of laws whose F/delta is constant or falls as k_t does; without it a law whose F/delta
  /// falls otherwise gives rolling energy.
  template <class V>
  static V rolling_change(const Contact<V>& /*c*/, const ContactConstants<V>& /*k*/, const NormalForce<V>& f,
                          const V* /*history*/) {
    return f.shear_change;
  }
  /// k_t where dF/d(delta) is `stiffness` [N/m].
  static double shear_stiffness(const PairConstants& k, double /*stiffness*/) { return k.shear_stiffness; }
  /// Of the normal dashpot in critical ones.
  static double damping_share(double /*damping*/, double /*stiffness*/, double /*mass*/) { return 0; }
  /// 25 steps in the shortest contact.
  static LawSteps steps(const LightGrains& g) {
    return {linear_contact_time(g.stiffness, 0.5 * g.mass) / 25, packing_step(g.stiffness, g.mass)};
  }
  /// Of two springs in series, each of which is half of a contact of its own material.
  static double in_series(double a, double b) { return a > 0 && b > 0 ? 2 * a * b / (a + b) : 0.0; }
};

/// Components of a history that no law exceeds.
inline constexpr std::size_t most_history = 4;

/// One contact as a record sees it.
struct PointContact {
  double overlap, separation, radius, mass, dt;
};
struct PointForce {
  double elastic, shear_stiffness, shear_change, rolling_change, energy;
};

/// Friction and rolling resistance that some pair of a scene has.
enum class Roughness { smooth, sliding, rolling };

/// A law as code knows it that is not compiled for it (laws/contact/registry.hpp makes it of the struct).
struct ContactLaw {
  std::string_view word, name;
  std::span<const LawKey> keys;
  bool dashpot;
  const ContactLaw* by_rate;  ///< nullptr: contact.normal_damping has no meaning
  std::span<const Parity> history;
  PairConstants (*constants)(const MaterialPair&);
  double (*stiffness)(const PairConstants&, double radius, double overlap);
  double (*shear_stiffness)(const PairConstants&, double stiffness);
  double (*damping_share)(double damping, double stiffness, double mass);
  LawSteps (*steps)(const LightGrains&);
  PointForce (*respond)(const PointContact&, std::span<const double, 8> constants, const double* history);
  ContactFusion (*fusion)(Roughness, bool one_material);
};

/// All laws; from the first look on none can be added.
[[nodiscard]] std::span<const ContactLaw* const> contact_laws();
/// Throws std::logic_error where the word is taken, a key has another meaning already, or laws have been looked at.
void register_contact_law(const ContactLaw& law);

/// Of a scene of grains, that of contact.normal_damping where it is given.
[[nodiscard]] const ContactLaw& contact_law(const Scene& scene);
/// The fusion that it needs: normal law, friction, rolling resistance, one material or several.
[[nodiscard]] ContactFusion contact_fusion(const Scene& scene);

}  // namespace sph
