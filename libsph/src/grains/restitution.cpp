#include "sph/contact/restitution.hpp"

#include <cmath>
#include <numbers>

#include "sph/error.hpp"
#include "sph/exact_math.hpp"

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

}  // namespace

double damping_ratio(bool pull, double restitution) {
  if (!(restitution > 0 && restitution <= 1)) throw InputError("restitution must be above 0 and at most 1");
  if (restitution == 1) return 0.0;
  const double loss = -exact_log(restitution);
  if (pull) return loss / std::sqrt(std::numbers::pi * std::numbers::pi + loss * loss);
  return loss <= 2.0 ? underdamped(loss) : overdamped(loss);
}

double damping_of(ContactLaw law, bool pull, double restitution) {
  const double factor = law == ContactLaw::hertz ? 2.0 * std::sqrt(5.0 / 6.0) : 2.0;
  return factor * damping_ratio(pull, restitution);
}

}  // namespace sph
