// Small dense systems of the exact solutions: Gauss with pivots scaled by their rows.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

namespace test_stokes {

/// The last column of `m` is the right-hand side.
template <int N>
void solve(long double (&m)[N][N + 1], long double (&x)[N]) {
  const auto largest = [&](int r) {
    long double s = 0;
    for (int i = 0; i < N; ++i) s = std::max(s, std::fabs(m[r][i]));
    return s > 0 ? s : 1;
  };
  for (int p = 0; p < N; ++p) {
    int best = p;
    for (int r = p; r < N; ++r)
      if (std::fabs(m[r][p]) / largest(r) > std::fabs(m[best][p]) / largest(best)) best = r;
    std::swap(m[p], m[best]);
    for (int r = 0; r < N; ++r) {
      if (r == p) continue;
      const long double f = m[r][p] / m[p][p];
      for (int q = p; q <= N; ++q) m[r][q] -= f * m[p][q];
    }
  }
  for (int i = 0; i < N; ++i) x[i] = m[i][N] / m[i][i];
}

}  // namespace test_stokes
