#include "sph/laws/mohr_coulomb.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sph {
namespace {

using Vector = std::array<double, 3>;

double dot(const Vector& a, const Vector& b) { return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]; }

/// One of the planes that bound what is elastic: normal.s <= limit; plastic strain flows along `flow`.
struct Plane {
  Vector normal, flow, stress_of_flow;
  double limit;
};

constexpr std::size_t first_of_tension = 3;
struct Surface {
  std::array<Plane, 6> planes;  // shear 13, 23, 12, tension 1, 2, 3
  double shear_modulus, tolerance;
};

Surface surface_of(const StrengthConstants& k, const Vector& s) {
  const double lambda = k.bulk_modulus - 2 * k.shear_modulus / 3;
  const double tension = std::fmin(k.tensile_strength, cone_tip(k));
  const double plus = 1 + k.sin_friction, minus = -(1 - k.sin_friction);
  const double out = 1 + k.sin_dilatancy, in = -(1 - k.sin_dilatancy);
  const double limit = 2 * k.cohesion * k.cos_friction;
  const auto plane = [&](const Vector& n, const Vector& m, double most) {
    const double volume = lambda * ((m[0] + m[1]) + m[2]);
    Vector c{};
    for (std::size_t i = 0; i < 3; ++i) c[i] = volume + 2 * k.shear_modulus * m[i];
    return Plane{n, m, c, most};
  };
  const Vector e1{1, 0, 0}, e2{0, 1, 0}, e3{0, 0, 1};
  constexpr double rounding = 1e-13;
  const double size = std::fmax(std::fabs(s[0]), std::fabs(s[2])) + k.cohesion;
  return {{plane({plus, 0, minus}, {out, 0, in}, limit), plane({0, plus, minus}, {0, out, in}, limit),
           plane({plus, minus, 0}, {out, in, 0}, limit), plane(e1, e1, tension), plane(e2, e2, tension),
           plane(e3, e3, tension)},
          k.shear_modulus,
          rounding * size};
}

/// Planes that a stress may end on together.
struct Active {
  StressRegion region;
  std::array<std::size_t, 3> planes;
  std::size_t count;
};
constexpr std::array<Active, 10> all_active{{
    {StressRegion::shear, {0}, 1},
    {StressRegion::tension, {3}, 1},
    {StressRegion::edge_12, {0, 1}, 2},
    {StressRegion::edge_23, {0, 2}, 2},
    {StressRegion::shear_tension, {0, 3}, 2},
    {StressRegion::tension_edge, {3, 4}, 2},
    {StressRegion::tip_12, {0, 1, 3}, 3},
    {StressRegion::tip_12, {0, 3, 4}, 3},
    {StressRegion::tip_23, {0, 2, 3}, 3},
    {StressRegion::tension_tip, {3, 4, 5}, 3},
}};

/// Gauss's elimination with the largest of a column as pivot; what is singular gives what is not finite.
Vector solve(std::array<std::array<double, 4>, 3>& a, std::size_t n) {
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (std::fabs(a[i][k]) > std::fabs(a[pivot][k])) pivot = i;
    std::swap(a[k], a[pivot]);
    for (std::size_t i = k + 1; i < n; ++i) {
      const double factor = a[i][k] / a[k][k];
      for (std::size_t j = k; j < 4; ++j) a[i][j] -= factor * a[k][j];
    }
  }
  Vector x{};
  for (std::size_t k = n; k-- > 0;) {
    double sum = a[k][3];
    for (std::size_t j = k + 1; j < n; ++j) sum -= a[k][j] * x[j];
    x[k] = sum / a[k][k];
  }
  return x;
}

struct Candidate {
  Vector stress, amounts{};
  double violation;
};

double largest_excess(const Surface& f, const Vector& s) {
  double most = std::fmax(s[1] - s[0], s[2] - s[1]);
  for (const Plane& p : f.planes)
    if (p.limit < std::numeric_limits<double>::infinity()) most = std::fmax(most, dot(p.normal, s) - p.limit);
  return most;
}

Candidate end_on(const Surface& f, const Active& active, const Vector& trial) {
  Candidate c{trial, {}, 0};
  constexpr int passes = 2;  // the second takes the rounding of a far trial away
  for (int pass = 0; pass < passes; ++pass) {
    std::array<std::array<double, 4>, 3> a{};
    for (std::size_t i = 0; i < active.count; ++i) {
      const Plane& p = f.planes[active.planes[i]];
      for (std::size_t j = 0; j < active.count; ++j)
        a[i][j] = dot(p.normal, f.planes[active.planes[j]].stress_of_flow);
      a[i][3] = dot(p.normal, c.stress) - p.limit;
    }
    const Vector more = solve(a, active.count);
    for (std::size_t j = 0; j < active.count; ++j) {
      c.amounts[j] += more[j];
      for (std::size_t i = 0; i < 3; ++i)
        c.stress[i] -= more[j] * f.planes[active.planes[j]].stress_of_flow[i];
    }
  }
  c.violation = largest_excess(f, c.stress);
  for (std::size_t j = 0; j < active.count; ++j)
    c.violation = std::fmax(c.violation, -2 * f.shear_modulus * c.amounts[j]);
  return c;
}

StressReturn returned(const Surface& f, const Active& active, const Candidate& c) {
  Vector strain{};
  for (std::size_t j = 0; j < active.count; ++j)
    for (std::size_t i = 0; i < 3; ++i) strain[i] += c.amounts[j] * f.planes[active.planes[j]].flow[i];
  StressReturn out{c.stress, active.region};
  out.plastic_shear = std::fmax(std::fmax(strain[0], strain[1]), strain[2]) -
                      std::fmin(std::fmin(strain[0], strain[1]), strain[2]);
  out.plastic_volume = std::fmax((strain[0] + strain[1]) + strain[2], 0.0);
  for (std::size_t j = 0; j < active.count; ++j)
    if (active.planes[j] >= first_of_tension) out.opening += std::fmax(c.amounts[j], 0.0);
  return out;
}

}  // namespace

double cone_tip(const StrengthConstants& k) {
  return k.sin_friction > 0 ? k.cohesion * k.cos_friction / k.sin_friction
                            : std::numeric_limits<double>::infinity();
}

double beyond_mohr_coulomb(const StrengthConstants& k, const std::array<double, 3>& s) {
  const double shear = ((s[0] - s[2]) + (s[0] + s[2]) * k.sin_friction) - 2 * k.cohesion * k.cos_friction;
  return std::fmax(shear, s[0] - std::fmin(k.tensile_strength, cone_tip(k)));
}

StressReturn return_to_mohr_coulomb(const StrengthConstants& k, const std::array<double, 3>& trial) {
  const Surface f = surface_of(k, trial);
  if (!(beyond_mohr_coulomb(k, trial) > f.tolerance)) return {trial};
  const Active* best = nullptr;
  Candidate of_best{trial, {}, std::numeric_limits<double>::infinity()};
  for (const Active& active : all_active) {
    const Candidate c = end_on(f, active, trial);
    // fmax() drops what is not a number: it must not look like a fit
    const bool finite = std::isfinite((c.stress[0] + c.stress[1]) + c.stress[2]);
    if (!finite || !(c.violation < of_best.violation)) continue;
    best = &active;
    of_best = c;
    if (c.violation <= f.tolerance) break;
  }
  return best == nullptr ? StressReturn{trial} : returned(f, *best, of_best);
}

}  // namespace sph
