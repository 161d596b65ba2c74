// SolCx: a unit square with free slip, viscosity 1 left of x = 1/2 and B right of it, driven by f_y = sin pi y cos pi x
// (Duretz et al. 2011). Its exact flow is u = W(x) cos pi y, v = -W'(x)/pi sin pi y, p = P(x) cos pi y with W a
// particular solution and four solutions of the biharmonic equation on each side; walls and the joint give eight equations.
#pragma once

namespace test_stokes {

class SolCx {
 public:
  explicit SolCx(double contrast);
  [[nodiscard]] double u(double x, double y) const;
  [[nodiscard]] double v(double x, double y) const;
  [[nodiscard]] double p(double x, double y) const;

 private:
  enum class What { flow, slope, shear_free, pressure, shear, normal };
  struct Derivatives {
    long double w[4];
  };
  [[nodiscard]] static Derivatives basis(int i, long double x, int side);
  [[nodiscard]] long double of(const Derivatives& d, int side, long double force, What what) const;
  [[nodiscard]] long double particular(long double x, int side, What what) const;
  [[nodiscard]] long double at(long double x, What what) const;

  long double eta_[2];
  long double c_[8] = {};  ///< of the basis, four a side
};

}  // namespace test_stokes
