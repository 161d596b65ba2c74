#include "sph/laws/principal_stress.hpp"

#include <cmath>
#include <utility>

namespace sph {
namespace {

struct Rotated {
  std::array<std::array<double, 3>, 3> a, v;
};

/// Makes a[p][q] zero.
void rotate(Rotated& m, std::size_t p, std::size_t q) {
  const double off = m.a[p][q];
  if (off == 0) return;
  const double theta = (m.a[q][q] - m.a[p][p]) / (2 * off);
  const double t = (theta < 0 ? -1.0 : 1.0) / (std::fabs(theta) + std::sqrt(theta * theta + 1));
  const double c = 1 / std::sqrt(t * t + 1), s = t * c;
  const std::size_t r = 3 - p - q;
  m.a[p][p] -= t * off;
  m.a[q][q] += t * off;
  m.a[p][q] = m.a[q][p] = 0;
  const double rp = m.a[r][p], rq = m.a[r][q];
  m.a[r][p] = m.a[p][r] = c * rp - s * rq;
  m.a[r][q] = m.a[q][r] = s * rp + c * rq;
  for (std::size_t k = 0; k < 3; ++k) {
    const double vp = m.v[k][p], vq = m.v[k][q];
    m.v[k][p] = c * vp - s * vq;
    m.v[k][q] = s * vp + c * vq;
  }
}

}  // namespace

PrincipalAxes principal_axes(const SymmetricTensor& t) {
  constexpr int most_sweeps = 12;  // five do, convergence is quadratic
  constexpr double rounding = 1e-17;
  Rotated m{{{{t[0], t[3], t[4]}, {t[3], t[1], t[5]}, {t[4], t[5], t[2]}}},
            {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    const double off = std::fabs(m.a[0][1]) + std::fabs(m.a[0][2]) + std::fabs(m.a[1][2]);
    const double size = std::fabs(m.a[0][0]) + std::fabs(m.a[1][1]) + std::fabs(m.a[2][2]);
    if (off <= rounding * size) break;
    rotate(m, 0, 1);
    rotate(m, 0, 2);
    rotate(m, 1, 2);
  }
  std::array<std::size_t, 3> order{0, 1, 2};
  const auto sort = [&](std::size_t i, std::size_t j) {
    if (m.a[order[i]][order[i]] < m.a[order[j]][order[j]]) std::swap(order[i], order[j]);
  };
  sort(0, 1);
  sort(1, 2);
  sort(0, 1);
  PrincipalAxes out;
  for (std::size_t k = 0; k < 3; ++k) {
    out.values[k] = m.a[order[k]][order[k]];
    for (std::size_t i = 0; i < 3; ++i) out.axes[k][i] = m.v[i][order[k]];
  }
  return out;
}

SymmetricTensor tensor_of(const PrincipalAxes& p) {
  const auto at = [&](std::size_t i, std::size_t j) {
    return (p.values[0] * (p.axes[0][i] * p.axes[0][j]) + p.values[1] * (p.axes[1][i] * p.axes[1][j])) +
           p.values[2] * (p.axes[2][i] * p.axes[2][j]);
  };
  return {at(0, 0), at(1, 1), at(2, 2), at(0, 1), at(0, 2), at(1, 2)};
}

}  // namespace sph
