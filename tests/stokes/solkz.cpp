#include "stokes/solkz.hpp"

#include <cmath>
#include <numbers>

#include "stokes/gauss.hpp"

namespace test_stokes {
namespace {

constexpr long double pi = std::numbers::pi_v<long double>;

}  // namespace

SolKz::SolKz(double k, double m, double contrast)
    : k_(k * pi), m_(m * pi), b_(0.5L * std::log(static_cast<long double>(contrast))) {
  const Complex s = std::sqrt(Complex(b_ * b_ + k_ * k_, 2 * k_ * b_));
  root_[0] = -b_ - s;
  root_[1] = -b_ + s;
  const Complex r = forced_root_ = Complex(-2 * b_, m_), up = r + 2 * b_;
  const long double k2 = k_ * k_;
  forced_ = k2 / ((up * up + k2) * (r * r + k2) - 4 * k2 * r * up);
  long double rows[4][5];
  for (int row = 0; row < 4; ++row) {
    const int derivative = row % 2 == 0 ? 0 : 2;
    const long double y = row / 2;
    for (int i = 0; i < 2; ++i) {
      const Complex f = basis(i, derivative, y);
      rows[row][2 * i] = f.real();
      rows[row][2 * i + 1] = f.imag();
    }
    rows[row][4] = -(forced_ * std::pow(r, derivative) * std::exp(r * y)).imag();
  }
  solve(rows, c_);
}

/// 1 at most: the one that grows counts from above.
SolKz::Complex SolKz::basis(int i, int derivative, long double y) const {
  return std::pow(root_[i], derivative) * std::exp(root_[i] * (y - i));
}

long double SolKz::flow(int derivative, long double y) const {
  long double sum = (forced_ * std::pow(forced_root_, derivative) * std::exp(forced_root_ * y)).imag();
  for (int i = 0; i < 2; ++i) {
    const Complex f = basis(i, derivative, y);
    sum += c_[2 * i] * f.real() + c_[2 * i + 1] * f.imag();
  }
  return sum;
}

double SolKz::viscosity(double y) const { return static_cast<double>(std::exp(2 * b_ * y)); }
double SolKz::force(double x, double y) const {
  return static_cast<double>(std::sin(m_ * y) * std::cos(k_ * x));
}
double SolKz::u(double x, double y) const { return static_cast<double>(-flow(1, y) / k_ * std::sin(k_ * x)); }
double SolKz::v(double x, double y) const { return static_cast<double>(flow(0, y) * std::cos(k_ * x)); }

// T' = -eta (2B (V''/k + k V) + V'''/k + k V')
double SolKz::p(double x, double y) const {
  const long double shear = 2 * b_ * (flow(2, y) / k_ + k_ * flow(0, y)) + flow(3, y) / k_ + k_ * flow(1, y);
  return static_cast<double>(std::exp(2 * b_ * y) * (shear / k_ - 2 * flow(1, y)) * std::cos(k_ * x));
}

}  // namespace test_stokes
