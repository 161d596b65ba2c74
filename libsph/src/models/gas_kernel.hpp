// What the kernel sums near a particle of an ideal gas say: how wide its kernel shall be and how many such
// particles fill a volume of spacing^D, N = 1 / V. Walls fill a share s of the kernel: N (1 - s) = sum W.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sph {

/// A width grows by no more in a step, whatever happens: lists must hold until its end.
inline constexpr double fastest_growth = 1.07;
inline constexpr double fastest_shrinking = 0.8;
/// A compressed kernel is as wide as the scene's again where walls fill this share of it.
inline constexpr double share_at_walls = 0.02;

struct GasSums {
  double width;      ///< of the kernel over that of the scene
  double factor;     ///< alpha (spacing / h)^D
  double zero;       ///< w(0)
  double gas;        ///< sum of w over the gas
  double walls;      ///< sum of V w over walls
  double gas_slope;  ///< sums of q w'(q)
  double walls_slope;
};

struct GasKernel {
  double width;
  double number;      ///< N at that width
  double correction;  ///< 1 / Omega
  double open;        ///< 1 - s
};

[[nodiscard]] inline GasKernel gas_kernel(const GasSums& sums, int dim, double smallest, double largest) {
  const auto power = [dim](double x) { return dim == 2 ? x * x : x * x * x; };
  const double at_wall = std::fmax(sums.width, 1.0);
  const double share = sums.factor * sums.walls / power(at_wall), open = 1 - share;
  // g + 1 = N s^D and its derivative
  const double filled = sums.factor * (sums.zero + sums.gas) / open;
  const double share_slope =
      sums.width < 1 ? 0.0
                     : -sums.factor * (dim * sums.walls + sums.walls_slope) / (power(at_wall) * at_wall);
  const double slope = -sums.factor * sums.gas_slope / (sums.width * open) + filled * share_slope / open;
  const double g = filled - 1;
  const double wanted = slope > 0 ? sums.width - g / slope : (g < 0 ? largest : 0.0);
  const double least = std::fmax(smallest, std::fmin(1.0, share / share_at_walls));
  const double bounded = std::fmin(std::fmax(wanted, least), largest);
  GasKernel kernel{};
  kernel.open = open;
  kernel.width = std::fmin(std::fmax(bounded, fastest_shrinking * sums.width), fastest_growth * sums.width);
  kernel.number = (filled + slope * (kernel.width - sums.width)) / power(kernel.width);
  // Omega = 1 + s / (D N) dN/ds; a kernel at a bound does not follow.
  const double omega = bounded == wanted ? sums.width * slope / (dim * filled) : 1.0;
  kernel.correction = 1 / std::fmax(omega, 0.1);
  return kernel;
}

/// G = B M^-1 from the moments M = sum w x x (upper triangle, row by row) and B = sum w v x (row by row), 0
/// where the neighbours lie in a line or a plane.
template <int D>
void solve_gradient(const double* moments, double scale, double* gradient) {
  const double* const b = moments + D * (D + 1) / 2;
  double inverse[D][D], determinant, flat, trace;
  if constexpr (D == 2) {
    const double xx = moments[0], xy = moments[1], yy = moments[2];
    determinant = xx * yy - xy * xy;
    trace = xx + yy;
    flat = 1e-4 * trace * trace;
    inverse[0][0] = yy, inverse[1][1] = xx, inverse[0][1] = inverse[1][0] = -xy;
  } else {
    const double xx = moments[0], xy = moments[1], xz = moments[2], yy = moments[3], yz = moments[4],
                 zz = moments[5];
    inverse[0][0] = yy * zz - yz * yz;
    inverse[0][1] = inverse[1][0] = xz * yz - xy * zz;
    inverse[0][2] = inverse[2][0] = xy * yz - xz * yy;
    inverse[1][1] = xx * zz - xz * xz;
    inverse[1][2] = inverse[2][1] = xy * xz - xx * yz;
    inverse[2][2] = xx * yy - xy * xy;
    determinant = xx * inverse[0][0] + xy * inverse[0][1] + xz * inverse[0][2];
    trace = xx + yy + zz;
    flat = 1e-6 * trace * trace * trace;
  }
  for (int a = 0; a < D; ++a)
    for (int c = 0; c < D; ++c) {
      double sum = 0;
      for (int k = 0; k < D; ++k) sum += b[a * D + k] * inverse[k][c];
      gradient[a * D + c] = determinant > flat ? sum / determinant * scale : 0.0;
    }
}

}  // namespace sph
