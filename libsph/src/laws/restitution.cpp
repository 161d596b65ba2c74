#include "sph/laws/contact/restitution.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sph/core/error.hpp"
#include "sph/core/exact_math.hpp"

namespace sph {

namespace {

/// The root in [low, high] of a function that falls (or rises) through `value`. 64 halvings leave 2^-64 of
/// the bracket, below the last bit of the roots that are not close to 0.
template <class F>
double bisect(double low, double high, bool rises, double value, F function) {
  for (int k = 0; k < 64; ++k) {
    const double middle = 0.5 * (low + high);
    const bool below = function(middle) < value;
    (below == rises ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// zeta of 2 t / tan t = loss, 0 < loss <= 2: falls from 2 at t = 0 (zeta = 1) to 0 at pi/2 (zeta = 0).
double underdamped(double loss) {
  const double t = bisect(0.0, 0.5 * std::numbers::pi, false, loss,
                          [](double x) { return 2.0 * x * exact_cos(x) / exact_sin(x); });
  return exact_cos(t);
}

/// zeta of 2 u / tanh u = loss > 2: rises from 2 at u = 0 (zeta = 1), and u < loss/2.
double overdamped(double loss) {
  const double u = bisect(0.0, 0.5 * loss, true, loss, [](double x) {
    const double q = exact_exp(-2.0 * x);
    return 2.0 * x * (1.0 + q) / (1.0 - q);
  });
  return 0.5 * (exact_exp(u) + exact_exp(-u));
}

constexpr double least_followed = 1e-3;  // below, grains hardly part, and take ever smaller steps

/// Mean speed after over speed before of impacts that begin at all parts of a step.
double followed_restitution(const ReducedImpact& law, bool pull, double damping, double change, double step) {
  constexpr int phases = 64, longest = 100000;
  const double before = std::sqrt(law.speed_square);
  double sum = 0;
  for (int p = 0; p < phases; ++p) {
    double x = (p + 0.5) / phases * before * step, v = before;
    for (int n = 0; n < longest && x > 0; ++n) {
      const double tangent = law.tangent(x);
      const double dashpot = damping * std::sqrt(tangent) + change * step * tangent;
      const double force = law.elastic * tangent * x + dashpot * v;
      if (force > 0 || pull) v -= force * step;
      x += v * step;
    }
    sum += x > 0 ? 0.0 : -v;
  }
  return sum / (phases * before);
}

}  // namespace

double damping_ratio(bool pull, double restitution) {
  if (!(restitution > 0 && restitution <= 1)) throw InputError("restitution must be above 0 and at most 1");
  if (restitution == 1) return 0.0;
  const double loss = -exact_log(restitution);
  if (pull) return loss / std::sqrt(std::numbers::pi * std::numbers::pi + loss * loss);
  return loss <= 2.0 ? underdamped(loss) : overdamped(loss);
}

double damping_of(const ReducedImpact& law, bool pull, double restitution) {
  return 2.0 * std::sqrt(law.damping_square) * damping_ratio(pull, restitution);
}

double damping_slope(const ReducedImpact& law, bool pull, double restitution) {
  const double wanted = std::max(restitution, least_followed);
  const double damping = damping_of(law, pull, wanted), half = 0.5 * damping;
  if (damping == 0) return 0.0;
  const double step = std::min(law.reference_step, std::sqrt(1 + half * half) - half);
  const double share = bisect(-0.5, 0.0, false, wanted, [&](double s) {
    return followed_restitution(law, pull, damping, s * damping * damping, step);
  });
  const double real = damping_of(law, pull, restitution);
  return share * real * real;
}

}  // namespace sph
