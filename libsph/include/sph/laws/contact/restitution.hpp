// The damping of a normal law with a dashpot (linear.hpp, hertz.hpp) that gives a wanted restitution e of a
// head-on impact.
// A linear contact is m* x'' = -k x - 2 zeta sqrt(k m*) x'. The Hertz contact with its dashpot is the same
// oscillator in y = x^(5/4) and the time of dtau = x^(1/4) dt, with zeta = A / sqrt(5) for the reduced
// x'' = -x^(3/2) - A x^(1/4) x', A = sqrt(3/2) damping (Antypov & Elliott 2011), and y'' = 0 where the force
// is 0: one zeta(e) serves both laws, damping = 2 zeta or 2 sqrt(5/6) zeta, and e never depends on speed.
// Set-up code whose bits feed the state: exact_math and sqrt alone, a fixed number of bisections.
#pragma once

namespace sph {

/// A law's impact on a spring whose tangent stiffness S is 1 at the largest overlap of an undamped one, that
/// overlap and the mass being 1.
struct ReducedImpact {
  double damping_square;        ///< damping = 2 zeta times the root of it
  double speed_square;          ///< at the beginning
  double elastic;               ///< elastic force in S x
  double (*tangent)(double x);  ///< S at the overlap x
  double reference_step;        ///< for which damping_slope() is found, about the default one
};

/// Share of critical damping, 0 for e = 1; throws InputError unless 0 < e <= 1.
///   pull (the contact ends at x = 0):  e = exp(-pi zeta / sqrt(1 - zeta^2)), always below 1
///   else (it ends where the force is 0, Schwager & Poeschel 2007; their three cases are one function):
///     zeta = cos t:   e = exp(-2 t / tan t)        zeta = cosh u:   e = exp(-2 u / tanh u),  e < exp(-2)
[[nodiscard]] double damping_ratio(bool pull, double restitution);

/// ContactConstants::damping.
[[nodiscard]] double damping_of(const ReducedImpact& law, bool pull, double restitution);

/// ContactConstants::damping_change over the time step: with it an impact that is followed in steps, forces
/// from x^n and v^(n-1/2), kick, drift, has the restitution in the mean over the part of a step in which it
/// begins. Near -damping^2/4. What remains is of second order: below 1e-3 of e down to e = 0.1 at the default
/// step. A single impact differs from the mean by +-zeta dt sqrt(k/m) e, by where its first step falls.
[[nodiscard]] double damping_slope(const ReducedImpact& law, bool pull, double restitution);
/// ContactConstants::damping_change, 0 where there is no time step.
[[nodiscard]] inline double damping_change_of(const ReducedImpact& law, bool pull, double restitution,
                                              double dt) {
  return dt > 0 ? dt * damping_slope(law, pull, restitution) : 0.0;
}

}  // namespace sph
