// A slab of total-Lagrangian rock with a row of cracks, against the exact solution of collinear cracks of half-length a, 2b apart
// (Westergaard 1939; Tada, Paris & Irwin 2000, 7.1). Lengths are in spacings, stresses in Young's moduli.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "accuracy/bodies.hpp"
#include "accuracy/light_cylinder.hpp"

namespace measure {

inline constexpr double nu = 0.25, plane = 1 / (1 - nu * nu);  ///< E'

inline const std::string rock_and_melt = R"(
[[group]]
name = "rock"
kind = "solid"
lagrangian = "total"
density = 1
bulk_modulus = 0.6666666666666667
shear_modulus = 0.4
viscosity = 0.05
becomes = [{ group = "melt", toughness = 1, keeps = "volume" }]
[[group]]
name = "melt"
kind = "fluid"
density = 1
sound_speed = 0.7
viscosity = 0.05
)";

inline const std::string slab = R"(
dimension = 2
domain = { lower = [-200, -10], upper = [200, 10], periodic = [false, true] }
kernel = { h_over_dx = 1 }
)" + rock_and_melt + R"([[reset]]
lower = [-100, -100]
upper = [100, 100]
pressure = 1e-3
rise_time = 1
[time]
until = 1
cfl = 0.8
)";

/// Of cracks of m failed rows on either side of the centre; turned: along the diagonals of the lattice.
struct Row {
  int m, rows;  ///< rows of the lattice along y in a period, odd
  bool turned;
  [[nodiscard]] double row() const { return turned ? std::numbers::sqrt2 : 1.0; }
  [[nodiscard]] double half_length() const { return (m + 0.5) * row(); }
  [[nodiscard]] double period() const { return rows * row(); }
  [[nodiscard]] double angle() const { return std::numbers::pi * half_length() / period(); }
  [[nodiscard]] double opening(double p) const {
    return 4 * p * period() / (std::numbers::pi * plane) * std::acosh(1 / std::cos(angle()));
  }
  [[nodiscard]] double intensity(double p) const { return p * std::sqrt(period() * std::tan(angle())); }
  /// Of one crack: the integral of its opening.
  [[nodiscard]] double volume(double p) const {
    const double b = 0.5 * period();
    return -16 * p * b * b / (std::numbers::pi * plane) * std::log(std::cos(angle()));
  }

  /// `closes`: rate at which the slab is shortened at the start.
  [[nodiscard]] sph::Simulation start(const decomp::Comm& comm, const std::vector<std::string>& overrides,
                                      double closes = 0) const {
    Bodies body(1);
    const double half = 0.5 * period();
    const int n = turned ? static_cast<int>(period() / row()) : static_cast<int>(period());
    for (int j = -n; j <= n; ++j)
      for (int i = -n; i <= n; ++i) {
        const double x = turned ? (i - j) / row() : i, y = turned ? (i + j) / row() : j;
        if (y < -half || y >= half || std::abs(x) > 0.55 * period()) continue;
        body.add(x, y, -closes * x, 0, std::abs(x) < 0.1 && std::abs(y) < half_length() ? 1 : 0);
      }
    std::vector<std::string> all = overrides;
    char domain[160];
    std::snprintf(domain, sizeof domain,
                  "domain={lower=[-200, %.17g], upper=[200, %.17g], periodic=[false, true]}", -half, half);
    all.push_back(domain);
    return body.start(comm, slab, 1, all);
  }
};

/// How far the rows beside the middle of the crack are further apart than at the start.
inline double opened(const sph::Simulation& s, const Row& row) {
  double right = 0, left = 0;
  int n = 0;
  const double beside = row.turned ? std::numbers::sqrt2 / 2 : 1;
  const std::int64_t* u = s.particles().data<sph::Field::displacement>();
  const std::vector<Sample> all = samples(s);
  for (std::size_t k = 0; k < all.size(); ++k) {
    const double moved = s.scale().metres(u[2 * k]) - s.scale().metres(0), x = all[k].x[0] - moved;
    if (std::abs(all[k].x[1]) > 0.8 || std::abs(std::abs(x) - beside) > 0.1) continue;
    (x > 0 ? right : left) += moved;
    if (x > 0) ++n;
  }
  return (right - left) / n;
}

inline double largest(const sph::Simulation& s, sph::Field f) {
  double most = -1e300;
  const double* values = s.particles().table().as<double>(s.particles().column(f));
  for (std::size_t k = 0; k < s.particles().owned(); ++k) most = std::max(most, values[k]);
  return most;
}

}  // namespace measure
