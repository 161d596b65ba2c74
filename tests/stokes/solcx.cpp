#include "stokes/solcx.hpp"

#include <cmath>

#include "stokes/gauss.hpp"

namespace test_stokes {
namespace {

const long double pi = std::acos(-1.0L);

}  // namespace

SolCx::SolCx(double contrast) : eta_{1, contrast} {
  long double m[8][9] = {};
  const auto add = [&](int row, int side, long double x, What what, long double sign) {
    for (int i = 0; i < 4; ++i) m[row][4 * side + i] += sign * of(basis(i, x, side), side, 0, what);
    m[row][8] -= sign * particular(x, side, what);
  };
  add(0, 0, 0, What::flow, 1);
  add(1, 0, 0, What::shear_free, 1);
  add(2, 1, 1, What::flow, 1);
  add(3, 1, 1, What::shear_free, 1);
  int row = 4;
  for (const What what : {What::flow, What::slope, What::shear, What::normal}) {
    add(row, 0, 0.5L, what, 1);
    add(row++, 1, 0.5L, what, -1);
  }
  solve(m, c_);
}

// cosh kx', sinh kx', x' cosh kx', x' sinh kx' with x' from the wall of that side, and three derivatives.
SolCx::Derivatives SolCx::basis(int i, long double x, int side) {
  const long double k = pi, y = x - side, c = std::cosh(k * y), s = std::sinh(k * y);
  switch (i) {
    case 0:
      return {{c, k * s, k * k * c, k * k * k * s}};
    case 1:
      return {{s, k * c, k * k * s, k * k * k * c}};
    case 2:
      return {{y * c, c + y * k * s, 2 * k * s + y * k * k * c, 3 * k * k * c + y * k * k * k * s}};
    default:
      return {{y * s, s + y * k * c, 2 * k * c + y * k * k * s, 3 * k * k * s + y * k * k * k * c}};
  }
}

long double SolCx::of(const Derivatives& d, int side, long double force, What what) const {
  const long double k = pi, eta = eta_[side], v = -d.w[1] / k, v2 = -d.w[3] / k;
  const long double p = (-force + 2 * eta * k * k * v - eta * (v2 - k * d.w[1])) / k;
  switch (what) {
    case What::flow:
      return d.w[0];
    case What::slope:
      return d.w[1];
    case What::shear_free:
      return d.w[2];
    case What::pressure:
      return p;
    case What::shear:
      return eta * (-k * d.w[0] - d.w[2] / k);
    case What::normal:
      break;
  }
  return -p + 2 * eta * d.w[1];
}

long double SolCx::particular(long double x, int side, What what) const {
  const long double k = pi, a = -1 / (4 * eta_[side] * k * k), s = std::sin(k * x), c = std::cos(k * x);
  return of({{a * s, a * k * c, -a * k * k * s, -a * k * k * k * c}}, side, c, what);
}

long double SolCx::at(long double x, What what) const {
  const int side = x > 0.5L ? 1 : 0;
  long double s = particular(x, side, what);
  for (int i = 0; i < 4; ++i) s += c_[4 * side + i] * of(basis(i, x, side), side, 0, what);
  return s;
}

double SolCx::u(double x, double y) const {
  return static_cast<double>(at(x, What::flow) * std::cos(pi * y));
}
double SolCx::v(double x, double y) const {
  return static_cast<double>(-at(x, What::slope) / pi * std::sin(pi * y));
}
double SolCx::p(double x, double y) const {
  return static_cast<double>(at(x, What::pressure) * std::cos(pi * y));
}

}  // namespace test_stokes
