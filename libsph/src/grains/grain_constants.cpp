#include "grains/grain_constants.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sph/contact/restitution.hpp"
#include "sph/contact/time_step.hpp"
#include "sph/grain_mass.hpp"
#include "sph/grains.hpp"

namespace sph {
namespace {

double in_series(double a, double b) { return a > 0 && b > 0 ? 2 * a * b / (a + b) : 0.0; }

}  // namespace

std::array<double, 8> constants_of(const Scene& scene, std::size_t a, std::size_t b, double dt) {
  const GrainMaterial &m = scene.groups[a].grain, &n = scene.groups[b].grain;
  const ContactControl& control = scene.contact;
  double friction = std::min(m.friction, n.friction);
  double rolling = std::min(m.rolling_friction, n.rolling_friction);
  double restitution = std::min(m.restitution, n.restitution);
  for (const ContactPair& p : control.pairs) {
    const bool same = p.groups == std::array{static_cast<int>(a), static_cast<int>(b)} ||
                      p.groups == std::array{static_cast<int>(b), static_cast<int>(a)};
    if (!same) continue;
    friction = p.friction.value_or(friction);
    rolling = p.rolling_friction.value_or(rolling);
    restitution = p.restitution.value_or(restitution);
  }
  double stiffness, shear;
  if (control.law == ContactLaw::hertz) {
    const auto compliance = [](const GrainMaterial& g) {
      return (1 - g.poisson_ratio * g.poisson_ratio) / g.young_modulus;
    };
    const auto shear_compliance = [](const GrainMaterial& g) {  // (2 - nu) / G, G = E / (2 (1 + nu))
      return (2 - g.poisson_ratio) * 2 * (1 + g.poisson_ratio) / g.young_modulus;
    };
    stiffness = 1 / (compliance(m) + compliance(n));
    shear = 1 / (shear_compliance(m) + shear_compliance(n));
  } else {
    stiffness = in_series(m.normal_stiffness, n.normal_stiffness);
    shear = in_series(m.tangential_stiffness, n.tangential_stiffness);
  }
  if (control.normal_damping)
    return {stiffness, shear,   *control.normal_damping, control.tangential_damping,
            friction,  rolling, control.rolling_damping, 0.0};
  return {stiffness,
          shear,
          damping_of(control.law, control.pull, restitution),
          control.tangential_damping,
          friction,
          rolling,
          control.rolling_damping,
          dt > 0 ? dt * damping_slope(control.law, control.pull, restitution) : 0.0};
}

double stiffest_contact(const Scene& scene, double radius) {
  double stiffest = 0;
  for (std::size_t a = 0; a < scene.groups.size(); ++a)
    for (std::size_t b = a; b < scene.groups.size(); ++b) {
      const double k = constants_of(scene, a, b, 0)[0];
      const double patch = std::sqrt(radius * scene.contact.largest_overlap * radius);
      stiffest = std::max(stiffest, scene.contact.law == ContactLaw::hertz ? 2 * k * patch : k);
    }
  return stiffest;
}

// Linear: 25 steps in the shortest contact. Hertz: 0.15 of the least Rayleigh time. The limit is that of one
// contact of the two lightest grains at the largest overlap, and of the springs and dashpots of friction and
// rolling there: as if on 2/7 m of the pair (spin lightens surfaces), and on the inertia 2/5 m r^2 of a
// grain.
GrainTimeSteps grain_time_steps(const Scene& scene) {
  const bool hertz = scene.contact.law == ContactLaw::hertz;
  double mass = std::numeric_limits<double>::infinity(), rayleigh = mass, radius = mass;
  for (const Group& g : scene.groups) {
    if (g.grain.least_radius <= 0 || g.grain.fixed) continue;
    mass = std::min(mass, grain_mass(g.density, g.grain.least_radius));
    radius = std::min(radius, g.grain.least_radius);
    if (hertz)
      rayleigh = std::min(rayleigh, rayleigh_time(g.grain.least_radius, g.density, g.grain.young_modulus,
                                                  g.grain.poisson_ratio));
  }
  const double stiffness = stiffest_contact(scene, radius);
  double damping = 0, sliding = 0, rolling = 0;
  for (std::size_t a = 0; a < scene.groups.size(); ++a)
    for (std::size_t b = a; b < scene.groups.size(); ++b) {
      const std::array<double, 8> k = constants_of(scene, a, b, 0);
      damping = std::max(damping, k[2]);
      if (k[4] > 0) sliding = std::max(sliding, hertz ? 4 * k[1] / k[0] * stiffness : k[1]);
      rolling = std::max(rolling, k[5]);
    }
  double zeta = 0.5 * damping;  // 2 zeta, 2 sqrt(5/6) zeta or gamma_n
  if (scene.contact.normal_damping) zeta *= std::sqrt(0.5 * mass / stiffness);
  GrainTimeSteps steps;
  steps.limit = linear_stable_step(stiffness, 0.5 * mass, zeta);
  if (sliding > 0) {
    const double share = 2.0 / 7.0 * sliding / stiffness;
    steps.limit = std::min(
        steps.limit,
        linear_stable_step(sliding, mass / 7, scene.contact.tangential_damping * zeta / std::sqrt(share)));
  }
  if (rolling > 0)  // contact/rolling.hpp: k_r = 2.25 k (mu_r r)^2, dashpot 2 eta sqrt(7/5 m r^2 k_r)
    steps.limit = std::min(steps.limit, linear_stable_step(2.25 * rolling * rolling * stiffness, 0.4 * mass,
                                                           std::sqrt(3.5) * scene.contact.rolling_damping));
  if (hertz) {
    steps.recommended = 0.15 * rayleigh;
    steps.advised = 0.2 * rayleigh;
  } else {
    steps.recommended = linear_contact_time(stiffness, 0.5 * mass) / 25;
    steps.advised = packing_step(stiffness, mass);
  }
  steps.recommended = std::min(steps.recommended, 0.5 * steps.limit);
  return steps;
}

}  // namespace sph
