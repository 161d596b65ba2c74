#include "models/grain_constants.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sph/laws/contact/law.hpp"
#include "sph/models/grain_limits.hpp"
#include "sph/scene/grain_mass.hpp"

namespace sph {
namespace {

/// Masses on the springs of a contact between grains as light as the scene has: along its normal, and along
/// its surfaces, which spin makes lighter.
struct ContactMass {
  double normal, sliding;
};

/// Of two grains, or of one and a mesh that it moves, whichever is less: 1/m + 1/M, 7/2 1/m + 1/M.
ContactMass lightest(const Scene& scene, double grain) {
  ContactMass least{0.5 * grain, grain / 7};
  for (const MeshWall& mesh : scene.grains.meshes) {
    const double m = mesh.drive.mass;
    if (!(m > 0)) continue;
    least.normal = std::min(least.normal, grain * m / (grain + m));
    least.sliding = std::min(least.sliding, grain * m / (grain + 3.5 * m));
  }
  return least;
}

PairConstants law_part(const std::array<double, 8>& k) { return {k[0], k[1], k[2], k[7]}; }

}  // namespace

std::array<double, 8> constants_of(const Scene& scene, std::size_t a, std::size_t b, double dt) {
  const GrainMaterial &m = scene.groups[a].grain, &n = scene.groups[b].grain;
  const ContactControl& control = scene.grains.contact;
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
  const PairConstants k = contact_law(scene).constants(
      {m.constants, n.constants, restitution, control.pull, dt, control.normal_damping.value_or(0)});
  return {k.stiffness, k.shear_stiffness,       k.damping,       control.tangential_damping, friction,
          rolling,     control.rolling_damping, k.damping_change};
}

double stiffest_contact(const Scene& scene, double radius, std::optional<double> overlap) {
  const ContactLaw& law = contact_law(scene);
  double stiffest = 0;
  for (std::size_t a = 0; a < scene.groups.size(); ++a)
    for (std::size_t b = a; b < scene.groups.size(); ++b)
      stiffest =
          std::max(stiffest, law.stiffness(law_part(constants_of(scene, a, b, 0)), radius,
                                           overlap.value_or(scene.grains.contact.largest_overlap) * radius));
  return stiffest;
}

// The default is the law's. The limit is that of one contact of the two lightest grains, or of one with a mesh
// that it moves, at the largest overlap, and of the springs and dashpots of friction and rolling there: on the
// inertia 2/5 m r^2 of a grain.
GrainTimeSteps grain_time_steps(const Scene& scene) {
  const ContactLaw& law = contact_law(scene);
  double mass = std::numeric_limits<double>::infinity(), radius = mass;
  for (const Group& g : scene.groups) {
    if (g.grain.least_radius <= 0 || g.grain.fixed) continue;
    mass = std::min(mass, grain_mass(g.density, g.grain.least_radius));
    radius = std::min(radius, g.grain.least_radius);
  }
  const double stiffness = stiffest_contact(scene, radius);
  double damping = 0, sliding = 0, rolling = 0;
  for (std::size_t a = 0; a < scene.groups.size(); ++a)
    for (std::size_t b = a; b < scene.groups.size(); ++b) {
      const std::array<double, 8> k = constants_of(scene, a, b, 0);
      damping = std::max(damping, k[2]);
      if (k[4] > 0) sliding = std::max(sliding, law.shear_stiffness(law_part(k), stiffness));
      rolling = std::max(rolling, k[5]);
    }
  const ContactMass on = lightest(scene, mass);
  const double zeta = law.damping_share(damping, stiffness, on.normal);
  GrainTimeSteps steps;
  steps.limit = linear_stable_step(stiffness, on.normal, zeta);
  if (sliding > 0) {
    const double share = on.sliding / on.normal * sliding / stiffness;
    steps.limit = std::min(
        steps.limit, linear_stable_step(sliding, on.sliding,
                                        scene.grains.contact.tangential_damping * zeta / std::sqrt(share)));
  }
  if (rolling > 0)  // pairs/rolling.hpp: k_r = 2.25 k (mu_r r)^2, dashpot 2 eta sqrt(7/5 m r^2 k_r)
    steps.limit =
        std::min(steps.limit, linear_stable_step(2.25 * rolling * rolling * stiffness, 0.4 * mass,
                                                 std::sqrt(3.5) * scene.grains.contact.rolling_damping));
  const LawSteps wanted = law.steps({scene.groups, stiffness, 2 * on.normal});
  steps.recommended = std::min(wanted.recommended, 0.5 * steps.limit);
  steps.advised = std::min(wanted.advised, steps.limit);
  return steps;
}

}  // namespace sph
