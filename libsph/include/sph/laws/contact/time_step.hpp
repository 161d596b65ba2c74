// Times of a contact, from which a scene of grains takes its time step. mass, radius: of the pair, reduced
// (Contact::mass, Contact::radius); zeta: damping_ratio(). Set-up code whose bits feed the state.
#pragma once

namespace sph {

/// Duration of an undamped linear contact, pi sqrt(m/k). Damping makes it pi / sqrt(1 - zeta^2) where the
/// dashpot may pull, 2 t / sin t, zeta = cos t (or the same of u and sinh), less, where it may not.
[[nodiscard]] double linear_contact_time(double stiffness, double mass);

/// The step at which kick and drift, forces from x and the last v, loses stability on one linear contact:
/// 2 (sqrt(1 + zeta^2) - zeta) sqrt(m/k), from det +- trace of its matrix. For the tangential spring and
/// dashpot: k_t, 2/7 m (spin lightens two spheres' surfaces) and that pair's own zeta.
[[nodiscard]] double linear_stable_step(double stiffness, double mass, double zeta);

/// Grains in a dense packing have many contacts: 0.17 sqrt(m/k), m of a grain (O'Sullivan & Bray 2004).
[[nodiscard]] double packing_step(double stiffness, double mass);

/// Largest overlap of an undamped Hertz impact, (15 m v^2 / (16 E* sqrt(R*)))^(2/5), v the speed of approach
/// (Johnson 1985, 11.2).
[[nodiscard]] double hertz_overlap(double modulus, double radius, double mass, double speed);

/// Its duration, 2.943275 of that overlap over v (Hertz 1882). v > 0.
[[nodiscard]] double hertz_contact_time(double modulus, double radius, double mass, double speed);

/// The time a surface wave takes along half a grain, pi R sqrt(rho/G) / (0.1631 nu + 0.8766), whatever the
/// speed; R of the grain. Hertz contacts want 0.2 of the least of the scene or less (Ning & Ghadiri 1996).
[[nodiscard]] double rayleigh_time(double radius, double density, double young_modulus, double poisson_ratio);

}  // namespace sph
