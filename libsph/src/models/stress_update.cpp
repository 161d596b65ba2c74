#include "sph/models/stress_update.hpp"

#include <array>

namespace sph {

namespace {

/// In the plane, W = ((0, -w), (w, 0)): with t = w dt/2 the Cayley transform is the rotation with
/// cos = (1 - t^2)/(1 + t^2), sin = 2t/(1 + t^2).
void rotate_plane(double* s, const double* g, double dt) {
  const double t = 0.25 * dt * (g[2] - g[1]);
  const double inverse = 1.0 / (1.0 + t * t);
  const double cos = (1.0 - t * t) * inverse;
  const double sin = 2.0 * t * inverse;
  const double xx = s[0], yy = s[1], xy = s[2];
  const double c2 = cos * cos, s2 = sin * sin, cs = cos * sin;
  s[0] = (c2 * xx + s2 * yy) - 2.0 * cs * xy;
  s[1] = (s2 * xx + c2 * yy) + 2.0 * cs * xy;
  s[2] = cs * (xx - yy) + (c2 - s2) * xy;
}

/// In space, W x = w cross x, w = curl(v)/2: with a = w dt/2 the Cayley transform is
/// Q = ((1 - a.a) 1 + 2 a a^T + 2 [a]x) / (1 + a.a)   (Rodrigues parameters).
void rotate_space(double* s, const double* g, double dt) {
  const double ax = 0.25 * dt * (g[7] - g[5]);
  const double ay = 0.25 * dt * (g[2] - g[6]);
  const double az = 0.25 * dt * (g[3] - g[1]);
  const double a2 = (ax * ax + ay * ay) + az * az;
  const double inverse = 1.0 / (1.0 + a2);
  const double diagonal = 1.0 - a2;
  const std::array<std::array<double, 3>, 3> q{
      {{(diagonal + 2.0 * ax * ax) * inverse, 2.0 * (ax * ay - az) * inverse, 2.0 * (ax * az + ay) * inverse},
       {2.0 * (ax * ay + az) * inverse, (diagonal + 2.0 * ay * ay) * inverse, 2.0 * (ay * az - ax) * inverse},
       {2.0 * (ax * az - ay) * inverse, 2.0 * (ay * az + ax) * inverse,
        (diagonal + 2.0 * az * az) * inverse}}};
  const std::array<std::array<double, 3>, 3> old{
      {{s[0], s[3], s[4]}, {s[3], s[1], s[5]}, {s[4], s[5], s[2]}}};
  std::array<std::array<double, 3>, 3> half{};  // Q s
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      half[i][j] = (q[i][0] * old[0][j] + q[i][1] * old[1][j]) + q[i][2] * old[2][j];
  const auto turned = [&](int i, int j) {
    return (half[i][0] * q[j][0] + half[i][1] * q[j][1]) + half[i][2] * q[j][2];
  };
  s[0] = turned(0, 0);
  s[1] = turned(1, 1);
  s[2] = turned(2, 2);
  s[3] = turned(0, 1);
  s[4] = turned(0, 2);
  s[5] = turned(1, 2);
}

}  // namespace

template <int D>
void update_deviator(double* s, const double* gradient, double shear_modulus, double dt) {
  const double* g = gradient;
  const double shear = shear_modulus * dt;  // times 2 D_ij = g_ij + g_ji
  if constexpr (D == 2) {
    rotate_plane(s, g, dt);
    const double third = (g[0] + g[3]) / 3.0;
    s[0] += 2.0 * shear * (g[0] - third);
    s[1] += 2.0 * shear * (g[3] - third);
    s[2] += shear * (g[1] + g[2]);
  } else {
    rotate_space(s, g, dt);
    const double third = ((g[0] + g[4]) + g[8]) / 3.0;
    s[0] += 2.0 * shear * (g[0] - third);
    s[1] += 2.0 * shear * (g[4] - third);
    s[2] += 2.0 * shear * (g[8] - third);
    s[3] += shear * (g[1] + g[3]);
    s[4] += shear * (g[2] + g[6]);
    s[5] += shear * (g[5] + g[7]);
  }
}

template <int D>
void update_hooke_literal(double* sigma, const double* gradient, double lambda, double mu, double dt) {
  const double* g = gradient;
  if constexpr (D == 2) {
    const double volumetric = lambda * (g[0] + g[3]);
    sigma[0] += dt * (volumetric + 2.0 * mu * g[0]);
    sigma[1] += dt * (volumetric + 2.0 * mu * g[3]);
    sigma[2] += dt * (mu * (g[1] + g[2]));
  } else {
    const double volumetric = lambda * ((g[0] + g[4]) + g[8]);
    sigma[0] += dt * (volumetric + 2.0 * mu * g[0]);
    sigma[1] += dt * (volumetric + 2.0 * mu * g[4]);
    sigma[2] += dt * (volumetric + 2.0 * mu * g[8]);
    sigma[3] += dt * (mu * (g[1] + g[3]));
    sigma[4] += dt * (mu * (g[2] + g[6]));
    sigma[5] += dt * (mu * (g[5] + g[7]));
  }
}

template void update_deviator<2>(double*, const double*, double, double);
template void update_deviator<3>(double*, const double*, double, double);
template void update_hooke_literal<2>(double*, const double*, double, double, double);
template void update_hooke_literal<3>(double*, const double*, double, double, double);

}  // namespace sph
