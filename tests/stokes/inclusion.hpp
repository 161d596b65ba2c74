// A round inclusion in pure shear (Schmid & Podladchikov 2003): viscosity eta_i within the radius a, 1 around it, far away
// the flow is (x, -y). With z = x + iy and the potentials phi, psi of Muskhelishvili (1953),
//   2 eta (u + iv) = phi - z conj(phi') - conj(psi),   p = -2 Re phi',
// and the force through a curve is the change of phi + z conj(phi') + conj(psi) along it. Around the inclusion
// phi = A / z, psi = -2 z + B / z^3, in it phi = 0, psi = -2 eta_i E z, where the flow is E (x, -y). That velocities and forces
// are those of both sides on |z| = a asks for
//   B = A a^2,   A / a^2 + 2 = 2 E,   A / a^2 - 2 = -2 eta_i E,   so   E = 2 / (1 + eta_i),   A = 2 a^2 (1 - eta_i) / (1 + eta_i).
#pragma once

#include <complex>

namespace test_stokes {

class Inclusion {
 public:
  Inclusion(double radius, double viscosity)
      : a2_(radius * radius), viscosity_(viscosity), phi_(2 * a2_ * (1 - viscosity) / (1 + viscosity)) {}
  [[nodiscard]] bool holds(double x, double y) const { return x * x + y * y < a2_; }
  [[nodiscard]] double viscosity(double x, double y) const { return holds(x, y) ? viscosity_ : 1; }
  [[nodiscard]] double u(double x, double y) const { return velocity(x, y).real(); }
  [[nodiscard]] double v(double x, double y) const { return velocity(x, y).imag(); }
  [[nodiscard]] double p(double x, double y) const {
    return holds(x, y) ? 0 : 2 * phi_ * (1.0 / std::pow(std::complex(x, y), 2)).real();
  }

 private:
  [[nodiscard]] std::complex<double> velocity(double x, double y) const {
    const std::complex z(x, y), bar(x, -y);
    if (holds(x, y)) return 2 / (1 + viscosity_) * bar;
    return bar + 0.5 * phi_ * (1.0 / z + z / (bar * bar) - a2_ / (bar * bar * bar));
  }

  double a2_, viscosity_, phi_;
};

}  // namespace test_stokes
