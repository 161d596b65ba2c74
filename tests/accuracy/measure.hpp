// Errors of a running scene against analytic references: what the accuracy tests and the printed table share.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "sph/core/kernels.hpp"
#include "sph/scene/scene.hpp"
#include "sph/step/simulation.hpp"

namespace measure {

/// A file of which nothing is left.
struct Removed {
  std::filesystem::path file;
  ~Removed() {
    std::error_code ignored;
    std::filesystem::remove(file, ignored);
  }
};

struct Sample {
  double x[3], v[3], rho, p, mass;
  unsigned group;
};

/// Owned particles of this rank (the accuracy cases run on one rank, so: all).
inline std::vector<Sample> samples(const sph::Simulation& s) {
  const sph::Particles& p = s.particles();
  const std::size_t d = static_cast<std::size_t>(p.dim());
  std::vector<Sample> out(p.owned());
  for (std::size_t i = 0; i < out.size(); ++i) {
    for (std::size_t a = 0; a < 3; ++a) {
      out[i].x[a] = a < d ? s.scale().metres(p.data<sph::Field::position>()[i * d + a]) : 0;
      out[i].v[a] = a < d ? p.data<sph::Field::velocity>()[i * d + a] : 0;
    }
    out[i].rho = p.data<sph::Field::density>()[i];
    out[i].p = p.data<sph::Field::pressure>()[i];
    out[i].mass = p.data<sph::Field::mass>()[i];
    out[i].group = p.data<sph::Field::group>()[i];
  }
  return out;
}

inline bool is_wall(const sph::Simulation& s, const Sample& q) {
  return s.scene().groups[q.group].kind == sph::GroupKind::wall;
}

/// Steps until t >= until, calling visit after every step.
inline void run_until(sph::Simulation& s, double until, const std::function<void()>& visit = {}) {
  while (s.global().time < until) {
    s.step();
    if (visit) visit();
  }
}

/// Sum of |u - u_exact| over sum of |u_exact|, and kinetic energy over exact, of the Taylor-Green flow with
/// U = L = rho = 1 and the scene's viscosity.
struct TaylorGreen {
  double l1, l2, kinetic;
};
inline TaylorGreen taylor_green(const sph::Simulation& s) {
  const double k = 2 * std::numbers::pi;
  const double decay = std::exp(-2 * s.scene().groups[0].viscosity * k * k * s.global().time);
  double error = 0, norm = 0, error2 = 0, norm2 = 0, energy = 0;
  for (const Sample& q : samples(s)) {
    const double u = -decay * std::cos(k * q.x[0]) * std::sin(k * q.x[1]);
    const double v = decay * std::sin(k * q.x[0]) * std::cos(k * q.x[1]);
    const double e2 = (q.v[0] - u) * (q.v[0] - u) + (q.v[1] - v) * (q.v[1] - v), n2 = u * u + v * v;
    error += std::sqrt(e2);
    norm += std::sqrt(n2);
    error2 += e2;
    norm2 += n2;
    energy += 0.5 * q.mass * (q.v[0] * q.v[0] + q.v[1] * q.v[1]);
  }
  // The exact mean of u^2 + v^2 is decay^2 / 2; the sum over particles would hide clumping.
  return {error / norm, std::sqrt(error2 / norm2), energy / (0.25 * decay * decay)};
}

/// Mean position of a group along an axis [m].
inline double mean_position(const sph::Simulation& s, const std::string& group, int axis) {
  double sum = 0;
  int n = 0;
  for (const Sample& q : samples(s))
    if (s.scene().groups[q.group].name == group) sum += q.x[axis], ++n;
  return sum / n;
}

/// Pressure noise (accuracy.md G): p less its kernel-weighted linear fit over the neighbours of the same
/// group, rms over all fluid [Pa]. In 2D; the weight is the quintic kernel's.
inline double pressure_noise(const sph::Simulation& s) {
  const std::vector<Sample> all = samples(s);
  const double h = s.scene().kernel.smoothing_length, reach = s.scene().support();
  std::vector<Sample> fluid;
  for (const Sample& q : all)
    if (s.scene().groups[q.group].kind == sph::GroupKind::fluid) fluid.push_back(q);
  std::sort(fluid.begin(), fluid.end(), [](const Sample& a, const Sample& b) { return a.x[0] < b.x[0]; });
  double sum = 0;
  for (std::size_t i = 0; i < fluid.size(); ++i) {
    double m[3][4] = {};  // normal equations of p ~ c0 + c1 dx + c2 dy
    const auto add = [&](const Sample& q) {
      const double dx = (q.x[0] - fluid[i].x[0]) / h, dy = (q.x[1] - fluid[i].x[1]) / h;
      const double r = std::sqrt(dx * dx + dy * dy);
      if (q.group != fluid[i].group || r >= reach / h) return;
      const double w = sph::Quintic::value<2>(r);
      const double basis[3] = {1, dx, dy};
      for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) m[a][b] += w * basis[a] * basis[b];
        m[a][3] += w * basis[a] * (q.p - fluid[i].p);
      }
    };
    for (std::size_t j = i; j < fluid.size() && fluid[j].x[0] - fluid[i].x[0] < reach; ++j) add(fluid[j]);
    for (std::size_t j = i; j-- > 0 && fluid[i].x[0] - fluid[j].x[0] < reach;) add(fluid[j]);
    const double det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                       m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                       m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    const double c0 = m[0][3] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                      m[0][1] * (m[1][3] * m[2][2] - m[1][2] * m[2][3]) +
                      m[0][2] * (m[1][3] * m[2][1] - m[1][1] * m[2][3]);
    const double fit = std::abs(det) > 1e-9 * m[0][0] * m[0][0] * m[0][0] ? c0 / det : m[0][3] / m[0][0];
    sum += fit * fit;
  }
  return std::sqrt(sum / static_cast<double>(fluid.size()));
}

}  // namespace measure
