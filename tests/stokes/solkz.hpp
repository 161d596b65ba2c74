// SolKz: a unit square with free slip, viscosity exp(2 B y), driven by f_y = sin m y cos k x (after Revenaugh & Parsons
// 1987). With u = -V'/k sin kx, v = V cos kx, p = P cos kx and the shear stress T sin kx,
//   T = -eta (V'' / k + k V),   P = -2 eta V' - T' / k,   -P' + (2 eta V')' + k T + sin my = 0,
// and so, with D = d/dy,
//   ((D + 2B)^2 + k^2)(D^2 + k^2) V - 4 k^2 D (D + 2B) V = k^2 exp(-2By) sin my.
// Its solutions are V = exp((-B +- s) y) with s^2 = B^2 + k^2 +- 2ikB, the particular one Im C exp((-2B + im) y); V and V''
// vanish at y = 0 and 1.
#pragma once

#include <complex>

namespace test_stokes {

class SolKz {
 public:
  /// k and m in units of pi, of which k is whole; `contrast` of the viscosity between top and bottom.
  SolKz(double k, double m, double contrast);
  [[nodiscard]] double viscosity(double y) const;
  [[nodiscard]] double force(double x, double y) const;
  [[nodiscard]] double u(double x, double y) const;
  [[nodiscard]] double v(double x, double y) const;
  [[nodiscard]] double p(double x, double y) const;

 private:
  using Complex = std::complex<long double>;
  [[nodiscard]] long double flow(int derivative, long double y) const;
  [[nodiscard]] Complex basis(int i, int derivative, long double y) const;

  long double k_, m_, b_;
  Complex root_[2], forced_root_,
      forced_;             ///< -B - s, -B + s, of one sign of the imaginary part; -2B + im, C
  long double c_[4] = {};  ///< of the real and imaginary parts of the two roots' solutions
};

}  // namespace test_stokes
